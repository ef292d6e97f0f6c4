"""Many CDR messages of one layout at once: stamps and doubles as arrays, and back.

All messages here are a ``std_msgs/Header`` (and, for odometry, one more string) followed by
float64 values only.  While the strings keep their length, every message of a topic has the same
layout, so a topic is rows of bytes; where layouts differ, :func:`decode_one`
takes message by message.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..core import FloatArray, IntArray
from .storage.message_rows import MessageRows

LITTLE_ENDIAN = b"\x00\x01\x00\x00"
BIG_ENDIAN = b"\x00\x00\x00\x00"
STAMP = 4  # after the encapsulation
TEXT = 12  # after seconds and nanoseconds


def decode(
    messages: Sequence[bytes] | MessageRows,
    doubles: int,
    texts: int = 1,
    kept: Sequence[slice] = (slice(None),),
) -> tuple[IntArray, list[FloatArray], list[str]] | None:
    """Return stamps (N,) ns, parts (N, K) and the strings; None if layouts differ.

    ``texts`` strings follow the stamp, then ``doubles`` float64, of which the columns ``kept`` are
    returned, each a part.  Little-endian messages only.
    """
    rows = MessageRows.of(messages)
    first = b"" if rows is None else rows[0]
    if rows is None or first[:4] != LITTLE_ENDIAN:
        return None
    read = _read_texts(first, texts)
    if read is None or len(first) < read[2] + 8 * doubles:
        return None
    strings, lengths_at, start = read
    head = rows.columns(0, start)
    if not all(_same(head[:, at : at + 4]) for at in (0, *lengths_at)):
        return None
    clock = head[:, STAMP:TEXT].copy()
    seconds, nanoseconds = clock.view("<i4")[:, 0], clock.view("<u4")[:, 1]
    bounds = [part.indices(doubles) for part in kept]
    parts = [rows.columns(start + 8 * a, start + 8 * b).view("<f8") for a, b, _ in bounds]
    stamps = seconds.astype(np.int64) * 1_000_000_000 + nanoseconds
    return stamps, parts, strings


def decode_one(
    message: bytes, doubles: int, texts: int = 1
) -> tuple[int, tuple[float, ...], list[str]]:
    """Return stamp (ns), values and strings of one message, of either byte order.

    Raises
    ------
    ValueError
        When it is too short, or no plain CDR.
    """
    order = {LITTLE_ENDIAN: "<", BIG_ENDIAN: ">"}.get(message[:4])
    read = None if order is None else _read_texts(message, texts, order)
    if order is None or read is None or len(message) < read[2] + 8 * doubles:
        raise ValueError("it is too short or no CDR")
    seconds, nanoseconds = struct.unpack_from(f"{order}iI", message, STAMP)
    values = struct.unpack_from(f"{order}{doubles}d", message, read[2])
    return seconds * 1_000_000_000 + nanoseconds, values, read[0]


def decode_text(message: bytes) -> str:
    """Return the text of a message that is one string, of either byte order.

    Raises
    ------
    ValueError
        When it is too short, or no plain CDR.
    """
    order = {LITTLE_ENDIAN: "<", BIG_ENDIAN: ">"}.get(message[:4])
    if order is None or len(message) < 8:
        raise ValueError("it is too short or no CDR")
    (length,) = struct.unpack_from(f"{order}I", message, 4)
    if len(message) < 8 + length:
        raise ValueError("it is too short")
    return message[8 : 8 + length].removesuffix(b"\0").decode("utf-8", "replace")


def from_ros1(message: bytes, texts: int = 1) -> bytes:
    """Return a message of ROS 1 with a header as CDR; ``texts`` strings stand behind the stamp.

    ROS 1 has a sequence number before the stamp, strings without a closing zero, and no padding.

    Raises
    ------
    ValueError
        When the message is too short.
    """
    at, found = 4 + 8, list[str]()
    for _ in range(texts):
        length = int.from_bytes(message[at : at + 4], "little")
        if at + 4 + length > len(message):
            raise ValueError("it is too short")
        found.append(message[at + 4 : at + 4 + length].decode("utf-8", "replace"))
        at += 4 + length
    return _head(message[4:12], tuple(found)) + message[at:]


def _head(stamp: bytes, texts: tuple[str, ...]) -> bytes:
    """Return everything before the first double: stamp (8 bytes) and strings, padded."""
    head = bytearray(LITTLE_ENDIAN + stamp)
    for text in texts:
        head += bytes(-(len(head) - 4) % 4)
        data = text.encode() + b"\0"
        head += struct.pack("<I", len(data)) + data
    return bytes(head + bytes(-(len(head) - 4) % 8))


def encode(stamp_ns: IntArray, values: FloatArray, texts: tuple[str, ...]) -> NDArray[np.uint8]:
    """Return (N, length) bytes, one row a message, of stamps (N,) and values (N, doubles)."""
    prefix = _head(bytes(8), texts)
    raw = np.empty((len(stamp_ns), len(prefix) + 8 * values.shape[1]), dtype=np.uint8)
    raw[:, : len(prefix)] = np.frombuffer(prefix, dtype=np.uint8)
    seconds, nanoseconds = np.divmod(stamp_ns, 1_000_000_000)
    raw[:, 4:8] = seconds.astype("<i4")[:, None].view(np.uint8)
    raw[:, 8:12] = nanoseconds.astype("<u4")[:, None].view(np.uint8)
    raw[:, len(prefix) :] = np.ascontiguousarray(values, dtype="<f8").view(np.uint8)
    return raw


def _read_texts(
    message: bytes, texts: int, order: str = "<"
) -> tuple[list[str], list[int], int] | None:
    """Return the strings after the stamp, where their lengths stand, and the first double."""
    strings, lengths_at, at = [], [], TEXT
    for _ in range(texts):
        at += -(at - 4) % 4
        if at + 4 > len(message):
            return None
        (length,) = struct.unpack_from(f"{order}I", message, at)
        lengths_at.append(at)
        at += 4
        if at + length > len(message):
            return None
        strings.append(message[at : at + max(0, length - 1)].decode("utf-8", "replace"))
        at += length
    return strings, lengths_at, at + -(at - 4) % 8


def _same(lengths: NDArray[np.uint8]) -> bool:
    """Return whether four bytes (N, 4) are the same in all messages."""
    numbers = np.ascontiguousarray(lengths).view(np.uint32)
    return bool((numbers == numbers[0]).all())
