"""Bags read by rosbag2_py, which a stock ROS 2 has, where rosbags is not installed."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path, PurePath
from typing import Any

from .bag_source import Block, Message, TopicInfo, in_blocks
from .sqlite_rows import SqliteRows

ROWS = ".db3"
STORAGE_OF_SUFFIX = {".mcap": "mcap", ROWS: "sqlite3"}


class Rosbag2PySource:
    """A rosbag2 folder, or one file of it."""

    cut = ""

    def __init__(self, path: Path) -> None:
        """Open ``path``; raises RuntimeError when it cannot be read."""
        self._path = path
        metadata = self._open().get_metadata()
        self._files = [PurePath(name).name for name in metadata.relative_file_paths]
        self.topics = {
            entry.topic_metadata.name: TopicInfo(entry.topic_metadata.type, entry.message_count)
            for entry in metadata.topics_with_message_count
        }
        custom = getattr(metadata, "custom_data", None) or {}
        self.custom = {str(key): str(value) for key, value in custom.items()}

    def _open(self) -> Any:
        import rosbag2_py

        reader = rosbag2_py.SequentialReader()
        storage = STORAGE_OF_SUFFIX.get(self._path.suffix, "")
        reader.open(
            rosbag2_py.StorageOptions(uri=str(self._path), storage_id=storage),
            rosbag2_py.ConverterOptions("", ""),
        )
        return reader

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, those of each file as they stand in it.

        The rows of sqlite3 are read here: rosbag2_py has them by log time only.
        """
        if all(name.endswith(ROWS) for name in self._files):
            for number, name in enumerate(self._files):
                path = self._path / name if self._path.is_dir() else self._path
                yield from SqliteRows(path, number).blocks(topics)
            return
        for block in in_blocks(self._messages(topics)):
            yield block._replace(file=0)

    def _messages(self, topics: Collection[str]) -> Iterator[Message]:
        import rosbag2_py

        wanted = [topic for topic in self.topics if topic in topics]
        if not wanted:
            return
        reader = self._open()
        reader.set_read_order(rosbag2_py.ReadOrder(rosbag2_py.ReadOrderSortBy.File, False))
        reader.set_filter(rosbag2_py.StorageFilter(topics=wanted))
        while reader.has_next():
            topic, data, log_ns = reader.read_next()
            yield Message(topic, int(log_ns), bytes(data))

    def close(self) -> None:
        """Do nothing: the reader closes with its last reference."""
