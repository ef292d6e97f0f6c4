"""MCAP files without an index, as a cut-off recording leaves them: read from the start."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from .bag_source import Block, Message, TopicInfo, in_blocks
from .mcap_format import (
    CHANNEL,
    CHUNK,
    CHUNK_HEAD,
    DATA_END,
    HEAD,
    MAGIC,
    MESSAGE,
    MESSAGE_HEAD,
    SCHEMA,
    zstd,
)

MAX_RECORD = 1 << 31
PIECE = 4096


class Record(NamedTuple):
    """One record; ``whole`` is False for a chunk of which the end is missing."""

    opcode: int
    content: bytes
    whole: bool = True


class McapScan:
    """The part of an MCAP file that is there, found without its index."""

    def __init__(self, path: Path) -> None:
        """Read the file once to list its topics.

        Raises
        ------
        ValueError
            When it does not begin as an MCAP file, or a chunk is compressed in an unknown way.
        """
        self._path = path
        self.custom: dict[str, str] = {}
        self._names: dict[int, str] = {}  # of channels
        self._types: dict[str, str] = {}
        self._schemas: dict[int, str] = {}
        self._ended, self._lacks = False, False
        counts = Counter(message.topic for message in self._messages(None))
        self.topics = {t: TopicInfo(m, counts[t]) for t, m in self._types.items()}
        whole = self._ended and not self._lacks
        self.cut = "" if whole else self._describe_cut(sum(counts.values()))

    def _describe_cut(self, messages: int) -> str:
        what = "is damaged" if self._ended else "was cut off before its end"
        return f"'{self._path.name}' {what}; the {messages} messages that are whole are read"

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` that are whole, in blocks."""
        return in_blocks(self._messages(topics))

    def close(self) -> None:
        """Do nothing: the file is open while it is read only."""

    def _messages(self, topics: Collection[str] | None) -> Iterator[Message]:
        with self._path.open("rb") as file:
            for record in _records(file):
                for opcode, content, _ in self._inner(record):
                    if opcode == MESSAGE:
                        yield from self._message(content, topics)
                    else:
                        self._learn(opcode, content)

    def _inner(self, record: Record) -> Iterator[Record]:
        """Yield the records of a chunk, as many as are whole, or the record itself."""
        if record.opcode != CHUNK:
            yield record
            return
        if len(record.content) < CHUNK_HEAD.size:
            return
        *_, size, _, _ = CHUNK_HEAD.unpack_from(record.content)
        records = _decompress(record.content)
        self._lacks = self._lacks or len(records) < size
        yield from split(records)

    def _message(self, content: bytes, topics: Collection[str] | None) -> Iterator[Message]:
        channel, _, log_ns, _ = MESSAGE_HEAD.unpack_from(content)
        topic = self._names.get(channel)
        if topic is not None and (topics is None or topic in topics):
            yield Message(topic, log_ns, content[MESSAGE_HEAD.size :])

    def _learn(self, opcode: int, content: bytes) -> None:
        """Take the name of a schema or of a channel, or the end of the data."""
        if opcode == SCHEMA:
            self._schemas[u16(content, 0)] = text(content, 2)
        elif opcode == CHANNEL:
            topic = text(content, 4)
            self._names[u16(content, 0)] = topic
            self._types[topic] = self._schemas.get(u16(content, 2), "")
        elif opcode == DATA_END:
            self._ended = True


def _records(file: BinaryIO) -> Iterator[Record]:
    """Yield the records of a file up to the end of its data, or to where it was cut."""
    if file.read(len(MAGIC)) != MAGIC:
        raise ValueError("it does not begin as an MCAP file")
    while len(head := file.read(HEAD.size)) == HEAD.size:
        opcode, length = HEAD.unpack(head)
        if opcode == 0 or length > MAX_RECORD:
            return  # zeros, or what was never a record
        content = file.read(length)
        whole = len(content) == length
        if whole or opcode == CHUNK:
            yield Record(opcode, content, whole)
        if not whole or opcode == DATA_END:
            return


def _decompress(chunk: bytes) -> bytes:
    """Return as much as there is of the records of a chunk."""
    length = CHUNK_HEAD.unpack_from(chunk)[4]
    start = CHUNK_HEAD.size + length + 8  # behind the size of the records
    name = chunk[CHUNK_HEAD.size : start - 8].decode("utf-8", "replace")
    return decompressor(name)(chunk[start:])


def split(records: bytes) -> Iterator[Record]:
    """Yield the records that follow each other in the bytes, as many as are whole."""
    at = 0
    while at + HEAD.size <= len(records):
        opcode, length = HEAD.unpack_from(records, at)
        at += HEAD.size + length
        if at > len(records):
            return
        yield Record(opcode, records[at - length : at])


def decompressor(name: str) -> Callable[[bytes], bytes]:
    """Return what decompresses as much as there is of a stream compressed by ``name``."""
    if name == "":
        return lambda data: data
    if name == "lz4":
        return _lz4
    if name == "zstd":
        return _zstd
    raise ValueError(f"its chunks are compressed by '{name}', which is not known here")


def _lz4(data: bytes) -> bytes:
    frame = import_module("lz4.frame")
    return _as_far_as_whole(frame.LZ4FrameDecompressor, data, (EOFError, RuntimeError))


def _zstd(data: bytes) -> bytes:
    library = zstd()
    return _as_far_as_whole(library.ZstdDecompressor, data, (EOFError, library.ZstdError))


def _as_far_as_whole(
    make: Callable[[], Any], data: bytes, errors: tuple[type[Exception], ...]
) -> bytes:
    """Return what comes out of all the data, or before the first piece that is damaged.

    ``make`` makes a decompressor, which is of no more use after an error.
    """
    with suppress(*errors):
        return bytes(make().decompress(data))
    found, decompress = bytearray(), make().decompress
    with suppress(*errors):
        for at in range(0, len(data), PIECE):
            found += decompress(data[at : at + PIECE])
    return bytes(found)


def u16(content: bytes, at: int) -> int:
    """Return the number of two bytes at ``at``."""
    return int.from_bytes(content[at : at + 2], "little")


def text(content: bytes, at: int) -> str:
    """Return the text at ``at``, behind its length of four bytes."""
    length = int.from_bytes(content[at : at + 4], "little")
    return content[at + 4 : at + 4 + length].decode("utf-8", "replace")
