"""Files of rosbag2's sqlite3 storage that are cut off: read row by row, as far as it goes."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Collection, Iterator
from contextlib import closing
from pathlib import Path

from .bag_source import Block, Message, TopicInfo, in_blocks

ROWS = "SELECT topic_id, timestamp, data FROM messages ORDER BY id"


class SqliteScan:
    """The part of a .db3 file that is there."""

    def __init__(self, path: Path) -> None:
        """Read the file once to list its topics.

        Raises
        ------
        sqlite3.Error
            When not even the topics can be read.
        """
        self._path = path
        self.custom: dict[str, str] = {}
        self._broken = ""
        with closing(self._connect()) as base:
            rows = base.execute("SELECT id, name, type FROM topics").fetchall()
        self._names = {number: str(name) for number, name, _ in rows}
        counts = Counter(message.topic for message in self._messages(self._names.values()))
        self.topics = {str(n): TopicInfo(str(kind), counts[str(n)]) for _, n, kind in rows}
        self.cut = self._describe_cut(sum(counts.values())) if self._broken else ""

    def _connect(self) -> sqlite3.Connection:
        """Open the whole pages of the file in memory; the half of a page would read as zeros."""
        data = self._path.read_bytes()
        page = int.from_bytes(data[16:18], "big")
        page = 65536 if page == 1 else page
        base = sqlite3.connect(":memory:")
        base.deserialize(data[: len(data) - len(data) % page] if page else data)
        base.execute("PRAGMA writable_schema=ON")  # or sqlite refuses a file with missing pages
        return base

    def _describe_cut(self, messages: int) -> str:
        return (
            f"'{self._path.name}' is cut off or damaged ({self._broken}); the {messages} messages "
            "before that are read"
        )

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` up to the first page that is missing, in blocks."""
        return in_blocks(self._messages(topics))

    def _messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics`` up to the first page that is missing."""
        wanted = {number: name for number, name in self._names.items() if name in topics}
        with closing(self._connect()) as base:
            try:
                for number, log_ns, data in base.execute(ROWS):
                    if number in wanted:
                        yield Message(wanted[number], int(log_ns), bytes(data))
            except sqlite3.Error as error:
                self._broken = str(error)

    def close(self) -> None:
        """Do nothing: the file is open while it is read only."""
