"""MCAP files written many messages at once; what a reader finds is what rosbags writes.

rosbags writes a message in some thirty small steps, which is most of the time of a long import.
Here the heads of many messages are one array, and a chunk is joined in one step.  The class takes
the place of the storage in ``rosbags.rosbag2.Writer``, which keeps the metadata.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...core import IntArray
from . import mcap_format as mcap

PROFILE, LIBRARY = "ros2", "dualfoot_ros"
CHUNK_BYTES = 1 << 20  # a chunk is closed by the message that exceeds this
MESSAGE_DTYPE = np.dtype(
    {
        "names": ["opcode", "length", "channel", "sequence", "log_ns", "publish_ns"],
        "formats": ["u1", "<u8", "<u2", "<u4", "<u8", "<u8"],
    }
)
HEAD_BYTES = MESSAGE_DTYPE.itemsize
BEHIND_LENGTH = mcap.MESSAGE_HEAD.size  # bytes of the head that its length counts
INDEX_DTYPE = np.dtype([("log_ns", "<u8"), ("offset", "<u8")])


class _Chunk:
    """Records that are not written yet; where each message starts, of which channel and time."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []
        self.size = 0
        self.index: list[tuple[IntArray, IntArray, IntArray]] = []

    def add(self, part: bytes) -> None:
        self.parts.append(part)
        self.size += len(part)

    def add_messages(
        self, channel: IntArray, log_ns: IntArray, ends: IntArray, data: Sequence[bytes]
    ) -> None:
        """Append messages; ``ends`` (N,) are the bytes of the records up to the end of each."""
        lengths = np.diff(ends, prepend=0)
        heads = np.zeros(len(data), dtype=MESSAGE_DTYPE)
        heads["opcode"] = mcap.MESSAGE
        heads["length"] = lengths - HEAD_BYTES + BEHIND_LENGTH
        heads["channel"] = channel
        heads["log_ns"] = heads["publish_ns"] = log_ns
        parts: list[bytes] = [b""] * (2 * len(data))
        parts[0::2] = heads.view(f"V{HEAD_BYTES}").tolist()
        parts[1::2] = data
        self.parts += parts
        self.index.append((channel, log_ns, self.size + ends - lengths))
        self.size += int(ends[-1])

    def by_message(self) -> tuple[IntArray, IntArray, IntArray]:
        """Return channel, log time and offset (N,) of every message."""
        if not self.index:
            return tuple(np.zeros((3, 0), dtype=np.int64))  # type: ignore[return-value]
        channel, log_ns, offset = (np.concatenate(part) for part in zip(*self.index, strict=True))
        return channel, log_ns, offset


class McapStorage:
    """One MCAP file in the folder of a bag, as rosbags' writer uses a storage."""

    def __init__(self, path: Path, compression: Any) -> None:
        """Create the file in folder ``path``; rosbags' mode STORAGE compresses its chunks."""
        packed = compression.name == "STORAGE"
        self.path = path / f"{path.name}.mcap"
        self._compression = "zstd" if packed else ""
        self._compress = mcap.zstd().compress if packed else bytes
        self._schemas: dict[str, tuple[int, bytes]] = {}
        self._channels: list[bytes] = []
        self._counts: dict[int, int] = {}
        self._chunk_indexes: list[bytes] = []
        self._span = (2**63 - 1, 0)
        self._chunk = _Chunk()
        self._file = self.path.open("xb")
        self._file.write(mcap.MAGIC)
        self._put(mcap.HEADER, mcap.text(PROFILE) + mcap.text(LIBRARY))

    def add_msgtype(self, connection: Any) -> None:
        """Add the definition of a type of messages."""
        encoding = "ros2msg" if connection.msgdef.format.name == "MSG" else "ros2idl"
        number = len(self._schemas) + 1
        content = struct.pack("<H", number) + b"".join(
            map(mcap.text, (connection.msgtype, encoding, connection.msgdef.data))
        )
        self._schemas[connection.msgtype] = (number, content)
        self._chunk.add(mcap.record(mcap.SCHEMA, content))

    def add_connection(self, connection: Any, offered_qos_profiles: str) -> None:
        """Add a topic."""
        schema = self._schemas[connection.msgtype][0]
        facts = mcap.text("offered_qos_profiles") + mcap.text(offered_qos_profiles)
        content = struct.pack("<HH", connection.id, schema)
        content += mcap.text(connection.topic) + mcap.text(connection.ext.serialization_format)
        content += mcap.sized(facts)
        self._channels.append(content)
        self._counts[connection.id] = 0
        self._chunk.add(mcap.record(mcap.CHANNEL, content))

    def write(self, connection: Any, timestamp: int, data: bytes | memoryview) -> None:
        """Write one message."""
        one = np.array([connection.id]), np.array([timestamp])
        self.write_many(*one, [bytes(data)])

    def write_many(self, channel: IntArray, log_ns: IntArray, data: Sequence[bytes]) -> None:
        """Write messages in their order: channel (N,), log time (N,) ns, and N times bytes."""
        ends = np.cumsum(np.fromiter(map(len, data), np.int64, len(data)) + HEAD_BYTES)
        first, before = 0, 0
        while first < len(data):
            room = before + CHUNK_BYTES - self._chunk.size
            last = min(int(np.searchsorted(ends, room, side="right")) + 1, len(data))
            part = slice(first, last)
            self._chunk.add_messages(channel[part], log_ns[part], ends[part] - before, data[part])
            first, before = last, int(ends[last - 1])
            if self._chunk.size > CHUNK_BYTES:
                self._close_chunk()

    def _put(self, opcode: int, content: bytes) -> tuple[int, int]:
        """Write a record; return where it starts, and its length."""
        at = self._file.tell()
        return at, self._file.write(mcap.record(opcode, content))

    def _close_chunk(self) -> None:
        chunk, self._chunk = self._chunk, _Chunk()
        channel, log_ns, offset = chunk.by_message()
        span = (int(log_ns.min()), int(log_ns.max())) if len(log_ns) else (2**63 - 1, 0)
        self._span = min(self._span[0], span[0]), max(self._span[1], span[1])
        packed = self._compress(b"".join(chunk.parts))
        content = struct.pack("<QQQI", *span, chunk.size, 0) + mcap.text(self._compression)
        at, length = self._put(mcap.CHUNK, content + struct.pack("<Q", len(packed)) + packed)
        offsets = self._put_indexes(channel, log_ns, offset)
        content = struct.pack("<QQQQ", *span, at, length)
        content += mcap.sized(offsets) + struct.pack("<Q", self._file.tell() - at - length)
        content += mcap.text(self._compression) + struct.pack("<QQ", len(packed), chunk.size)
        self._chunk_indexes.append(content)

    def _put_indexes(self, channel: IntArray, log_ns: IntArray, offset: IntArray) -> bytes:
        """Write the index of each channel of a chunk; return where they are."""
        offsets = b""
        for number in dict.fromkeys(channel.tolist()):  # in the order of their first messages
            mine = channel == number
            index = np.zeros(int(mine.sum()), dtype=INDEX_DTYPE)
            index["log_ns"], index["offset"] = log_ns[mine], offset[mine]
            self._counts[number] += len(index)
            content = struct.pack("<H", number) + mcap.sized(index.tobytes())
            offsets += struct.pack("<HQ", number, self._put(mcap.MESSAGE_INDEX, content)[0])
        return offsets

    def close(self, version: int, metadata: str) -> None:
        """Write what is left, ``metadata`` and the index of the file, and close it."""
        if self._chunk.size:
            self._close_chunk()
        name = mcap.text("rosbag2")
        facts = mcap.sized(mcap.text("serialized_metadata") + mcap.text(metadata))
        place = self._put(mcap.METADATA, name + facts)
        self._put(mcap.DATA_END, bytes(4))
        self._put_summary(struct.pack("<QQ", *place) + name)
        self._file.write(mcap.MAGIC)
        self._file.close()

    def _put_summary(self, metadata_index: bytes) -> None:
        groups = {
            mcap.SCHEMA: [content for _, content in self._schemas.values()],
            mcap.CHANNEL: self._channels,
            mcap.CHUNK_INDEX: self._chunk_indexes,
            mcap.METADATA_INDEX: [metadata_index],
            mcap.STATISTICS: [self._statistics()],
        }
        start, offsets = self._file.tell(), []
        for opcode, contents in groups.items():
            at = self._file.tell()
            for content in contents:
                self._put(opcode, content)
            if contents:
                offsets.append(struct.pack("<BQQ", opcode, at, self._file.tell() - at))
        offset_start = self._file.tell()
        for content in offsets:
            self._put(mcap.SUMMARY_OFFSET, content)
        self._put(mcap.FOOTER, struct.pack("<QQI", start, offset_start, 0))

    def _statistics(self) -> bytes:
        counts = b"".join(struct.pack("<HQ", *item) for item in sorted(self._counts.items()))
        totals = (sum(self._counts.values()), len(self._schemas), len(self._channels))
        parts = (0, 1, len(self._chunk_indexes))  # attachments, metadata, chunks
        return struct.pack("<QHIIIIQQ", *totals, *parts, *self._span) + mcap.sized(counts)

    def abort(self) -> None:
        """Close the file as it is."""
        self._file.close()
