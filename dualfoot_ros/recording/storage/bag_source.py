"""Sources of recorded messages: what every storage gives, whatever its format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .message_rows import MessageRows

BLOCK = 1 << 12  # messages that are handed on at once
SEVERAL_TYPES = "several types"


class TopicInfo(NamedTuple):
    """Type and number of messages of one topic of a bag."""

    msgtype: str
    messages: int


class Message(NamedTuple):
    """One recorded message: its topic, the time it was logged at (ns), and its CDR bytes."""

    topic: str
    log_ns: int
    data: bytes


class Block(NamedTuple):
    """Messages of one topic that follow each other.

    ``log_ns`` (K,) are the times they were logged at, ``rows`` their CDR bytes.  Blocks of one
    ``file`` are to be brought into the order of their log times
    (:func:`.log_order.recorded_order`); where it is None, their order is that of the recording.
    """

    topic: str
    log_ns: NDArray[np.int64]
    rows: MessageRows | Sequence[bytes]
    file: int | None = None


def in_blocks(messages: Iterable[Message]) -> Iterator[Block]:
    """Yield ``messages`` in blocks, each topic in its order."""
    waiting: dict[str, list[Message]] = {}
    for message in messages:
        own = waiting.setdefault(message.topic, [])
        own.append(message)
        if len(own) == BLOCK:
            yield _block(waiting.pop(message.topic))
    yield from (_block(own) for own in waiting.values())


def _block(messages: Sequence[Message]) -> Block:
    logged = np.array([message.log_ns for message in messages], dtype=np.int64)
    return Block(messages[0].topic, logged, [message.data for message in messages])


class BagSource(Protocol):
    """Messages of a bag that is open."""

    @property
    def topics(self) -> Mapping[str, TopicInfo]:
        """Type and number of messages by topic."""

    @property
    def custom(self) -> Mapping[str, str]:
        """Further facts that the bag carries."""

    @property
    def cut(self) -> str:
        """What of the bag cannot be read, as a sentence; empty for a whole one."""

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, file by file."""

    def close(self) -> None:
        """Close the files."""


@dataclass(frozen=True)
class Chained:
    """Several files of one bag, read one after the other."""

    parts: Sequence[BagSource]
    custom: Mapping[str, str] = field(default_factory=dict)

    @property
    def topics(self) -> dict[str, TopicInfo]:
        """Topics of all files together."""
        types: dict[str, str] = {}
        counts: Counter[str] = Counter()
        for part in self.parts:
            for topic, (msgtype, messages) in part.topics.items():
                same = types.setdefault(topic, msgtype) == msgtype
                types[topic] = msgtype if same else SEVERAL_TYPES
                counts[topic] += messages
        return {topic: TopicInfo(msgtype, counts[topic]) for topic, msgtype in types.items()}

    @property
    def cut(self) -> str:
        """What cannot be read of any of the files."""
        return "; ".join(part.cut for part in self.parts if part.cut)

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, file by file."""
        for number, part in enumerate(self.parts):
            for block in part.blocks(topics):
                yield block._replace(file=number)

    def close(self) -> None:
        """Close all files."""
        for part in self.parts:
            part.close()
