"""Bags read by rosbag2_py, which a stock ROS 2 has, where rosbags is not installed."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from .bag_source import Message, TopicInfo

STORAGE_OF_SUFFIX = {".mcap": "mcap", ".db3": "sqlite3"}


class Rosbag2PySource:
    """A rosbag2 folder, or one file of it."""

    cut = ""

    def __init__(self, path: Path) -> None:
        """Open ``path``; raises RuntimeError when it cannot be read."""
        self._path = path
        metadata = self._open().get_metadata()
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

    def messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics``."""
        import rosbag2_py

        wanted = [topic for topic in self.topics if topic in topics]
        if not wanted:
            return
        reader = self._open()
        reader.set_filter(rosbag2_py.StorageFilter(topics=wanted))
        while reader.has_next():
            topic, data, log_ns = reader.read_next()
            yield Message(topic, int(log_ns), bytes(data))

    def close(self) -> None:
        """Do nothing: the reader closes with its last reference."""
