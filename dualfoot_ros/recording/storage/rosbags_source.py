"""Bags read by the library rosbags: those of ROS 2 with an intact index, and those of ROS 1."""

from __future__ import annotations

import heapq
import struct
from collections.abc import Callable, Collection, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...core import IntArray
from .. import cdr
from ..topics import INCREMENTS_TYPE, TRUTH_TYPE
from .bag_source import SEVERAL_TYPES, Block, Message, TopicInfo, in_blocks
from .log_order import recorded_order
from .mcap_chunks import McapChunks
from .mcap_format import zstd
from .sqlite_rows import SqliteRows

if TYPE_CHECKING:
    from rosbags.rosbag1 import Reader as Reader1
    from rosbags.rosbag2 import Reader as Reader2

FILES: dict[str, Callable[[Path, int], McapChunks | SqliteRows]] = {
    ".mcap": McapChunks,
    ".db3": SqliteRows,
}


class RosbagsSource:
    """A rosbag2 folder, or one file of it."""

    cut = ""

    def __init__(self, path: Path) -> None:
        """Open ``path``; raises whatever a broken file leads the library to raise."""
        from rosbags.rosbag2 import Reader

        self._reader: Reader2 = Reader(path)
        self._reader.open()
        self.topics = _topics(self._reader)
        custom = self._reader.storage.metadata.custom
        usable = isinstance(custom, dict)  # none, or damaged: the samples are what matters
        self.custom = {str(k): str(v) for k, v in (custom or {}).items()} if usable else {}

    def messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics``, those of each file by log time."""
        wanted = [c for c in self._reader.connections if c.topic in topics]
        if wanted:  # no connection means all of them to the reader
            for connection, log_ns, data in self._reader.messages(wanted):
                yield Message(connection.topic, log_ns, data)

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, those of each file as they stand in it."""
        files = self._files()
        if files is None:
            yield from in_blocks(self.messages(topics))
            return
        single = self._reader.storage.metadata.compression_mode == "message"
        for file in files:
            yield from map(_decompressed, file.blocks(topics)) if single else file.blocks(topics)

    def _files(self) -> list[McapChunks | SqliteRows] | None:
        """Return the files of the bag; None where one of them cannot be read by itself."""
        storage = self._reader.storage
        parts = getattr(storage, "storages", [storage])
        paths = [Path(part.path) for part in parts if hasattr(part, "path")]
        if len(paths) != len(parts) or any(path.suffix not in FILES for path in paths):
            return None
        try:
            return [FILES[path.suffix](path, number) for number, path in enumerate(paths)]
        except (ValueError, OSError, struct.error):
            return None

    def close(self) -> None:
        """Close the files."""
        self._reader.close()


class Ros1Source:
    """A ``.bag`` of ROS 1, its messages turned into CDR."""

    cut = ""

    def __init__(self, path: Path) -> None:
        """Open ``path``; raises whatever a broken file leads the library to raise."""
        from rosbags.rosbag1 import Reader

        self._reader: Reader1 = Reader(path)
        self._reader.open()
        self.topics = _topics(self._reader)
        self.custom: dict[str, str] = {}

    def messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics`` by log time: with a header first, or strings."""
        wanted = [c for c in self._reader.connections if c.topic in topics]
        if wanted:
            for connection, log_ns, data in self._reader.messages(wanted):
                yield Message(connection.topic, log_ns, _to_cdr(connection.msgtype, data))

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, in the order of the recording."""
        orders = {topic: self._order(topic) for topic in self.topics if topic in topics}
        by_log = [topic for topic, order in orders.items() if (np.diff(order) > 0).all()]
        yield from in_blocks(self.messages(by_log))
        for topic in orders.keys() - by_log:
            yield _ordered(in_blocks(self.messages([topic])), orders[topic])

    def _order(self, topic: str) -> IntArray:
        """Return the order of the recording, as places among the messages by log time."""
        connections = [c for c in self._reader.connections if c.topic == topic]
        places = heapq.merge(*(self._reader.indexes[c.id] for c in connections))  # as it reads
        log_ns, chunk, offset = np.array([*places], dtype=np.int64).reshape(-1, 3).T
        written = np.lexsort((offset, chunk))
        return written[recorded_order(log_ns[written], np.zeros_like(log_ns))]

    def close(self) -> None:
        """Close the file."""
        self._reader.close()


def _ordered(blocks: Iterable[Block], order: IntArray) -> Block:
    """Return all messages of a topic in another order."""
    parts = list(blocks)
    rows = [row for part in parts for row in part.rows]
    logged = np.concatenate([part.log_ns for part in parts])
    return Block(parts[0].topic, logged[order], [rows[k] for k in order.tolist()])


def _decompressed(block: Block) -> Block:
    """Return the messages of a bag that is compressed message by message."""
    decompress = zstd().decompress
    return block._replace(rows=[decompress(bytes(row)) for row in block.rows])


def _to_cdr(msgtype: str, data: bytes) -> bytes:
    if msgtype == INCREMENTS_TYPE:
        return cdr.LITTLE_ENDIAN + data
    return cdr.from_ros1(data, 2 if msgtype == TRUTH_TYPE else 1)


def _topics(reader: Reader1 | Reader2) -> dict[str, TopicInfo]:
    return {
        topic: TopicInfo(info.msgtype or SEVERAL_TYPES, info.msgcount)
        for topic, info in reader.topics.items()
    }
