"""The bytes of a snapshot: a line that tells what it is, a checksum, and the state.

The first line is ``dualfoot snapshot 1``, the second the SHA-256 of what follows, in hexadecimal.
That is compressed by zlib: the length of the JSON part (8 bytes, little-endian), the JSON, and the
arrays one after the other, little-endian, in C order.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from typing import Any

import numpy as np

from ... import __version__
from ..errors import SnapshotError
from ..kernel import layout
from .object_graph import Decoder, Encoder

MAGIC = b"dualfoot snapshot "
VERSION = b"1"
KINDS = ("<f8", "<i8", "|b1", "<i4")  # of arrays


def dump(item: Any, about: dict[str, Any]) -> bytes:
    """Return ``item`` as the bytes of a snapshot; ``about`` is for people."""
    encoder = Encoder()
    root = encoder.encode(item)
    arrays = [np.asarray(each) for each in encoder.arrays]
    head = {
        "package": __version__,
        "layout": layout_key(),
        "about": about,
        "root": root,
        "objects": encoder.objects,
        "arrays": [{"dtype": a.dtype.str, "shape": a.shape} for a in arrays],
    }
    text = json.dumps(head).encode()
    parts = [len(text).to_bytes(8, "little"), text, *(a.tobytes() for a in arrays)]
    body = zlib.compress(b"".join(parts), 1)
    checksum = hashlib.sha256(body).hexdigest().encode()
    return b"\n".join([MAGIC + VERSION, checksum, body])


def restore(data: bytes) -> Any:
    """Return what was dumped.

    Raises
    ------
    SnapshotError
        When ``data`` is no snapshot, is damaged, or of another version.
    """
    text, raw = _open(_body(data))
    for what, here in (("package", __version__), ("layout", layout_key())):
        if text[what] != here:
            raise SnapshotError(
                f"the snapshot is of another version ({what} {text[what]}; here it is {here}); "
                "begin anew, or use the version that has written it"
            )
    return Decoder(text["objects"], _arrays(text["arrays"], raw)).decode(text["root"])


def _body(data: bytes) -> bytes:
    """Return the compressed part of a snapshot that is whole."""
    lines = data.split(b"\n", 2)
    if len(lines) < 3 or not lines[0].startswith(MAGIC):
        raise SnapshotError("the data is no snapshot of a tracker, or its beginning is damaged")
    version = lines[0].removeprefix(MAGIC)
    if version != VERSION:
        raise SnapshotError(
            f"the snapshot is of format {version.decode(errors='replace')}; this version of the "
            f"package reads {VERSION.decode()}"
        )
    if hashlib.sha256(lines[2]).hexdigest().encode() != lines[1]:
        raise SnapshotError("the snapshot is damaged or incomplete: its checksum does not fit")
    return lines[2]


def _open(body: bytes) -> tuple[dict[str, Any], bytes]:
    """Return the JSON part and the bytes of the arrays."""
    plain = zlib.decompress(body)
    end = 8 + int.from_bytes(plain[:8], "little")
    head: dict[str, Any] = json.loads(plain[8:end])
    return head, plain[end:]


def _arrays(heads: list[dict[str, Any]], raw: bytes) -> list[np.ndarray]:
    """Return the arrays, each with memory of its own."""
    arrays, at = [], 0
    for head in heads:
        if head["dtype"] not in KINDS:
            raise SnapshotError(f"an array of the snapshot is of {head['dtype']}")
        kind = np.dtype(head["dtype"])
        count = int(np.prod(head["shape"], dtype=np.int64))
        array = np.frombuffer(raw, kind, count, at).reshape(head["shape"]).copy()
        arrays.append(array)
        at += count * kind.itemsize
    return arrays


def layout_key() -> str:
    """Return what names the layout of the kernel's state."""
    numbers = sorted((k, v) for k, v in vars(layout).items() if isinstance(v, int | float))
    return hashlib.sha256(repr(numbers).encode()).hexdigest()[:16]
