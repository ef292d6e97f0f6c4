"""Bags read by the library rosbags: those of ROS 2 with an intact index, and those of ROS 1."""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .. import cdr
from ..topics import INCREMENTS_TYPE, TRUTH_TYPE
from .bag_source import SEVERAL_TYPES, Block, Message, TopicInfo, in_blocks
from .mcap_chunks import McapChunks

if TYPE_CHECKING:
    from rosbags.rosbag1 import Reader as Reader1
    from rosbags.rosbag2 import Reader as Reader2


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
        """Yield the messages of ``topics``."""
        wanted = [c for c in self._reader.connections if c.topic in topics]
        if wanted:  # no connection means all of them to the reader
            for connection, log_ns, data in self._reader.messages(wanted):
                yield Message(connection.topic, log_ns, data)

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks: by chunks where the files have any."""
        files = self._chunked_files()
        if files is None:
            yield from in_blocks(self.messages(topics))
        else:
            for file in files:
                yield from file.blocks(topics)

    def _chunked_files(self) -> list[McapChunks] | None:
        """Return the files of the bag by their chunks; None where they cannot be read so."""
        storage = self._reader.storage
        parts = getattr(storage, "storages", [storage])
        paths = [Path(part.path) for part in parts if hasattr(part, "path")]
        whole = storage.metadata.compression_mode != "message" and len(paths) == len(parts)
        if not whole or any(path.suffix != ".mcap" for path in paths):
            return None
        try:
            return [McapChunks(path, number) for number, path in enumerate(paths)]
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
        """Yield the messages of ``topics``, which begin with a header or are a string."""
        wanted = [c for c in self._reader.connections if c.topic in topics]
        if wanted:
            for connection, log_ns, data in self._reader.messages(wanted):
                yield Message(connection.topic, log_ns, _to_cdr(connection.msgtype, data))

    def close(self) -> None:
        """Close the file."""
        self._reader.close()


def _to_cdr(msgtype: str, data: bytes) -> bytes:
    if msgtype == INCREMENTS_TYPE:
        return cdr.LITTLE_ENDIAN + data
    return cdr.from_ros1(data, 2 if msgtype == TRUTH_TYPE else 1)


def _topics(reader: Reader1 | Reader2) -> dict[str, TopicInfo]:
    return {
        topic: TopicInfo(info.msgtype or SEVERAL_TYPES, info.msgcount)
        for topic, info in reader.topics.items()
    }
