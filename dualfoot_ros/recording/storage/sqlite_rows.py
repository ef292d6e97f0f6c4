"""Messages of a whole file of rosbag2's sqlite3 storage, in the order in which they were written.

Readers of these files give them by log time, and so exchange what was recorded before and after a
clock was set back; the numbers of the rows keep the order.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterator
from contextlib import closing
from pathlib import Path

from .bag_source import Block, Message, in_blocks

NAMES = "SELECT id, name FROM topics"
ROWS = "SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN ({}) ORDER BY id"


class SqliteRows:
    """The rows of a .db3 file."""

    def __init__(self, path: Path, number: int) -> None:
        """Keep the path; ``number`` is that of the file in its bag."""
        self._path, self._number = path, number

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks.

        Raises
        ------
        sqlite3.Error
            When the file is damaged.
        """
        for block in in_blocks(self._messages(topics)):
            yield block._replace(file=self._number)

    def _messages(self, topics: Collection[str]) -> Iterator[Message]:
        address = f"{self._path.resolve().as_uri()}?immutable=1"
        with closing(sqlite3.connect(address, uri=True)) as base:
            names = {n: str(name) for n, name in base.execute(NAMES) if name in topics}
            rows = base.execute(ROWS.format(",".join("?" * len(names))), tuple(names))
            for topic, log_ns, data in rows:
                yield Message(names[topic], int(log_ns), bytes(data))
