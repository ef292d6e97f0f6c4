"""Messages of a whole MCAP file, a chunk at once, in place of one by one.

The chunks are those of the file's own index; without one, or without chunks, there is nothing to
read here.  Records as in :mod:`mcap_format`.
"""

from __future__ import annotations

import struct
import zlib
from collections import defaultdict
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .bag_source import Block
from .mcap_format import CHANNEL, CHUNK_HEAD, CHUNK_INDEX, HEAD, MAGIC, MESSAGE
from .mcap_index import indexed_starts
from .mcap_scan import decompressor, split, text, u16
from .message_rows import MessageRows, rows_at

FOOTER = struct.Struct("<BQQQI8s")  # opcode, length, starts of summary and of its index, crc
RECORD = struct.Struct("<BQH")  # opcode and length of a record, and the channel of a message
HEAD_SIZE = 31  # of a message: opcode, length, channel, sequence, log time, publish time
LOG_AT = 15


class ChunkPlace(NamedTuple):
    """Where a chunk begins in its file, how long its record is, and the index behind it."""

    start: int
    length: int
    index_length: int


class McapChunks:
    """The chunks of an MCAP file, after its index."""

    def __init__(self, path: Path, number: int) -> None:
        """Read the index; ``number`` is that of the file in its bag.

        Raises
        ------
        ValueError
            When the file has no index of chunks.
        """
        self._path, self._number = path, number
        with path.open("rb") as file:
            summary = _summary(file)
        self._names: dict[int, str] = {}
        chunks = []
        for record in split(summary):
            if record.opcode == CHANNEL:
                self._names[u16(record.content, 0)] = text(record.content, 4)
            elif record.opcode == CHUNK_INDEX:
                chunks.append(_place(record.content))
        if not chunks or not self._names:
            raise ValueError("it has no index of chunks")
        self._chunks = sorted(chunks)

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics``, a block a chunk and topic.

        Raises
        ------
        ValueError
            When a chunk is damaged.
        """
        wanted = {number: name for number, name in self._names.items() if name in topics}
        with self._path.open("rb") as file:
            for place in self._chunks:
                file.seek(place.start + HEAD.size)
                records = _records(file.read(place.length - HEAD.size))
                starts = indexed_starts(file.read(place.index_length), records)
                for channel, places in (starts or _starts(records)).items():
                    if channel in wanted:
                        yield self._block(wanted[channel], records, places)

    def _block(self, topic: str, records: bytes, starts: NDArray[np.int64]) -> Block:
        """Return the messages whose records begin at ``starts``."""
        heads = rows_at(records, starts, HEAD_SIZE)
        logged = heads[:, LOG_AT : LOG_AT + 8].copy().view("<i8")[:, 0]
        lengths = heads[:, 1:9].copy().view("<i8")[:, 0] - (HEAD_SIZE - HEAD.size)
        first, bodies = int(lengths[0]), starts + HEAD_SIZE
        if first > 0 and (lengths == first).all():
            return Block(topic, logged, MessageRows(records, bodies, first), self._number)
        parts = zip(bodies.tolist(), lengths.tolist(), strict=True)
        return Block(topic, logged, [records[at : at + size] for at, size in parts], self._number)


def _place(content: bytes) -> ChunkPlace:
    """Return the place that a record of the index of chunks tells."""
    start, length, size = struct.unpack_from("<QQI", content, 16)
    return ChunkPlace(start, length, *struct.unpack_from("<Q", content, 36 + size))


def _summary(file: BinaryIO) -> bytes:
    """Return the records between the data and the end of the file."""
    end = file.seek(-FOOTER.size, 2)
    _, _, start, _, _, magic = FOOTER.unpack(file.read(FOOTER.size))
    if magic != MAGIC or not 0 < start <= end:
        raise ValueError("it has no summary")
    file.seek(start)
    return file.read(end - start)


def _records(chunk: bytes) -> bytes:
    """Return the records of a chunk, checked against its size and checksum."""
    _, _, size, checksum, length = CHUNK_HEAD.unpack_from(chunk)
    start = CHUNK_HEAD.size + length + 8
    name = chunk[CHUNK_HEAD.size : start - 8].decode()
    (compressed,) = struct.unpack_from("<Q", chunk, start - 8)
    records = decompressor(name)(chunk[start : start + compressed])
    if len(records) != size:
        raise ValueError(f"Chunk size mismatch: expected {size} bytes, got {len(records)}")
    if checksum and zlib.crc32(records) != checksum:
        raise ValueError("Chunk checksum mismatch")
    return records


def _starts(records: bytes) -> dict[int, NDArray[np.int64]]:
    """Return where the messages of each channel begin."""
    starts: dict[int, list[int]] = defaultdict(list)
    at, end, unpack = 0, len(records), RECORD.unpack_from
    while at < end:
        opcode, length, channel = unpack(records, at)
        if opcode == MESSAGE:
            starts[channel].append(at)
        at += HEAD.size + length
    if at != end:
        raise ValueError("a record is longer than its chunk")
    return {channel: np.array(own) for channel, own in starts.items()}
