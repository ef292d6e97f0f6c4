"""Constants and plain records of MCAP files, after the MCAP format specification.

A file is the magic bytes, then records of one opcode byte, a length of eight bytes and the
content, all little-endian, and the magic bytes again.  Chunks hold further records, compressed.
"""

from __future__ import annotations

import struct
import sys
from importlib import import_module
from typing import Any

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = range(0x01, 0x07)
MESSAGE_INDEX, CHUNK_INDEX = 0x07, 0x08
STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END = range(0x0B, 0x10)
HEAD = struct.Struct("<BQ")  # opcode and length of a record
MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
CHUNK_HEAD = struct.Struct("<QQQII")  # first and last time, size, checksum, length of a name


def record(opcode: int, content: bytes) -> bytes:
    """Return a whole record."""
    return HEAD.pack(opcode, len(content)) + content


def text(value: str) -> bytes:
    """Return a text behind its length."""
    return sized(value.encode())


def sized(content: bytes) -> bytes:
    """Return bytes behind their length of four bytes."""
    return struct.pack("<I", len(content)) + content


def zstd() -> Any:
    """Return the module that compresses and decompresses chunks."""
    return import_module("compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd")
