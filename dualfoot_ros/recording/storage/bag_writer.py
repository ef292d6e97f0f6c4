"""Writers of rosbag2 folders: by rosbags, or by rosbag2_py where that is not installed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib import util
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from ...core import IntArray, RecordingError
from .mcap_writer import McapStorage

NO_LIBRARY = (
    "bags need the package rosbags (pip install rosbags), or rosbag2_py of a ROS 2 installation "
    "(source its setup file first); neither is there"
)


class BagWriter(Protocol):
    """A bag that is being written."""

    def add_topic(self, topic: str, msgtype: str, *, latched_depth: int = 0) -> Any:
        """Add a topic and return its key for :meth:`write`.

        Players keep the last ``latched_depth`` messages for those who come late.
        """

    def write(self, key: Any, log_ns: int, data: bytes) -> None:
        """Write one message, as CDR bytes."""

    def write_many(
        self, keys: Sequence[Any], which: IntArray, log_ns: IntArray, data: Sequence[bytes]
    ) -> None:
        """Write messages in their order: place in ``keys`` (N,), log time (N,) ns, CDR bytes."""


def has_rosbags() -> bool:
    """Return whether the library rosbags is installed."""
    return util.find_spec("rosbags") is not None


def has_rosbag2_py() -> bool:
    """Return whether rosbag2_py of ROS 2 is there."""
    return util.find_spec("rosbag2_py") is not None


@contextmanager
def new_bag(
    folder: Path, storage: str, custom: Mapping[str, str] | None = None, *, packed: bool = True
) -> Iterator[BagWriter]:
    """Write the new folder ``folder`` in the block; ``packed`` compresses the chunks of MCAP.

    Raises
    ------
    RecordingError
        When neither library is installed.
    """
    packed = packed and storage == "mcap"  # zstd chunks, which every MCAP reader knows
    if has_rosbags():
        make = _rosbags
    elif has_rosbag2_py():
        make = _rosbag2_py
    else:
        raise RecordingError(NO_LIBRARY)
    with make(folder, storage, dict(custom or {}), packed) as writer:
        yield writer


class _Rosbags:
    def __init__(self, writer: Any) -> None:
        from rosbags.typesys import Stores, get_typestore

        self._writer, self._store = writer, get_typestore(Stores.ROS2_JAZZY)

    def add_topic(self, topic: str, msgtype: str, *, latched_depth: int = 0) -> Any:
        profiles = [_latched_qos(latched_depth)] if latched_depth else []
        return self._writer.add_connection(
            topic, msgtype, typestore=self._store, offered_qos_profiles=profiles
        )

    def write(self, key: Any, log_ns: int, data: bytes) -> None:
        self._writer.write(key, log_ns, data)

    def write_many(
        self, keys: Sequence[Any], which: IntArray, log_ns: IntArray, data: Sequence[bytes]
    ) -> None:
        if not hasattr(self._writer.storage, "write_many"):
            _one_by_one(self, keys, which, log_ns, data)
            return
        numbers = np.array([key.id for key in keys])
        self._writer.storage.write_many(numbers[which], log_ns, data)
        for key, count in zip(keys, np.bincount(which, minlength=len(keys)), strict=True):
            self._writer.counts[key.id] += int(count)
        self._writer.min_timestamp = min(self._writer.min_timestamp, int(log_ns.min()))
        self._writer.max_timestamp = max(self._writer.max_timestamp, int(log_ns.max()))


def _one_by_one(
    writer: BagWriter,
    keys: Sequence[Any],
    which: IntArray,
    log_ns: IntArray,
    data: Sequence[bytes],
) -> None:
    for place, stamp, message in zip(which.tolist(), log_ns.tolist(), data, strict=True):
        writer.write(keys[place], stamp, message)


def _latched_qos(depth: int) -> Any:
    """Return the QoS for a player to publish a topic with: reliable, transient local."""
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    never = QosTime(sec=2147483647, nsec=4294967295)
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=depth,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL,
        deadline=never,
        lifespan=never,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=never,
        avoid_ros_namespace_conventions=False,
    )


@contextmanager
def _rosbags(
    folder: Path, storage: str, custom: dict[str, str], packed: bool
) -> Iterator[BagWriter]:
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    writer = Writer(folder, version=9, storage_plugin=StoragePlugin[storage.upper()])
    writer.STORAGE_PLUGINS = {**writer.STORAGE_PLUGINS, StoragePlugin.MCAP: McapStorage}
    if packed:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    for key, value in custom.items():
        writer.set_custom_data(key, value)
    with writer:
        yield _Rosbags(writer)


class _Rosbag2Py:
    def __init__(self, writer: Any) -> None:
        self._writer: Any = writer
        self._topics = 0

    def add_topic(self, topic: str, msgtype: str, *, latched_depth: int = 0) -> str:
        import rosbag2_py

        metadata = rosbag2_py.TopicMetadata(
            id=self._topics, name=topic, type=msgtype, serialization_format="cdr"
        )
        if latched_depth:
            from rosbag2_py._storage import QoS

            metadata.offered_qos_profiles = [QoS(latched_depth).reliable().transient_local()]
        self._topics += 1
        self._writer.create_topic(metadata)
        return topic

    def write(self, key: str, log_ns: int, data: bytes) -> None:
        self._writer.write(key, data, log_ns)

    def write_many(
        self, keys: Sequence[Any], which: IntArray, log_ns: IntArray, data: Sequence[bytes]
    ) -> None:
        _one_by_one(self, keys, which, log_ns, data)

    def close(self) -> None:
        """Close the bag; older versions close with the last reference to the writer."""
        writer, self._writer = self._writer, None
        if hasattr(writer, "close"):
            writer.close()


@contextmanager
def _rosbag2_py(
    folder: Path, storage: str, custom: dict[str, str], packed: bool
) -> Iterator[BagWriter]:
    import rosbag2_py

    options = rosbag2_py.StorageOptions(uri=str(folder), storage_id=storage)
    options.custom_data = custom
    if packed:
        options.storage_preset_profile = "zstd_fast"
    writer = rosbag2_py.SequentialWriter()
    writer.open(options, rosbag2_py.ConverterOptions("cdr", "cdr"))
    opened = _Rosbag2Py(writer)
    del writer
    try:
        yield opened
    finally:
        opened.close()
