"""Bytes of a table as ASCII-compatible text: byte-order marks, line ends, zeros at the end."""

from __future__ import annotations

import codecs
from dataclasses import dataclass
from pathlib import Path

from ....core import RecordingError

BOMS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
PROBE = 4096  # bytes that tell the encoding
HEAD = 1 << 18  # bytes in which the names of the columns and the first rows stand
BINARY = 0.02  # share of control characters in no text
CONTROLS = bytes(range(9)) + bytes(range(14, 32))


@dataclass(frozen=True)
class RawText:
    """The text of one file.

    Attributes
    ----------
    path : the file
    data : the text in an encoding in which ASCII is ASCII, lines ended by a line feed
    encoding : how ``data`` is to be decoded
    original : the encoding of the file, for people
    ends_with_line : whether the last line was ended, so that its row is whole
    """

    path: Path
    data: bytes
    encoding: str
    original: str
    ends_with_line: bool

    def head(self) -> list[str]:
        """Return the first lines, decoded; the last one may be cut."""
        return self.data[:HEAD].decode(self.encoding, "replace").split("\n")

    def text(self, start: int = 0) -> str:
        """Return the text from byte ``start`` on."""
        return self.data[start:].decode(self.encoding, "replace")


def read_text(path: Path) -> RawText:
    """Read ``path``.

    Raises
    ------
    RecordingError
        When it is empty, or no text.
    OSError
        When it cannot be read.
    """
    data = path.read_bytes()
    encoding, data = _encoding_of(data)
    original = encoding
    if encoding.startswith("utf-16"):
        data, encoding = data.decode(encoding, "replace").encode(), "utf-8"
    data = data.rstrip(b"\0")  # a card that was pulled out leaves zeros
    if not data.strip():
        raise RecordingError(f"'{path}' is empty; record or export it again")
    probe = data[:PROBE]
    if len(probe) - len(probe.translate(None, CONTROLS)) > BINARY * len(probe):
        raise RecordingError(
            f"'{path}' is no text but binary data; allowed is a table as text (csv and the like)"
        )
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return RawText(path, data.lstrip(b"\n"), encoding, original, data.endswith(b"\n"))


def _encoding_of(data: bytes) -> tuple[str, bytes]:
    """Return encoding and the bytes after the byte-order mark."""
    for mark, name in BOMS:
        if data.startswith(mark):
            return name, data[len(mark) :]
    probe = data[: PROBE - PROBE % 2]
    if probe and probe[1::2].count(0) > len(probe) // 4:
        return "utf-16-le", data
    if probe and probe[0::2].count(0) > len(probe) // 4:
        return "utf-16-be", data
    try:
        data[:HEAD].decode("utf-8")
    except UnicodeDecodeError as error:
        cut = len(data) > HEAD and error.start > HEAD - len("\U0010ffff".encode())
        return ("utf-8" if cut else "cp1252"), data
    return "utf-8", data
