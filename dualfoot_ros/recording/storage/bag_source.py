"""Sources of recorded messages: what every storage gives, whatever its format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

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

    def messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics``, in the order in which they were logged."""

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

    def messages(self, topics: Collection[str]) -> Iterator[Message]:
        """Yield the messages of ``topics``, file by file."""
        for part in self.parts:
            yield from part.messages(topics)

    def close(self) -> None:
        """Close all files."""
        for part in self.parts:
            part.close()
