"""Reading of rosbag2 recordings into arrays."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..core import (
    FEET,
    FloatArray,
    ImuSeries,
    Increments,
    PoseSeries,
    PressureSeries,
    RecordingError,
)
from . import message_tables as messages
from .increments_topic import decode_kind
from .open_bag import iterate, opened
from .recording import Recording
from .reference import FILE_NAME, Reference
from .topics import (
    FIELD_TYPE,
    IMU_TYPE,
    INCREMENTS_TYPE,
    PRESSURE_TYPE,
    TRUTH_TYPE,
    Topics,
)

if TYPE_CHECKING:
    from rosbags.interfaces import Connection
    from rosbags.rosbag2 import Reader

Progress = Callable[[float], None]
NOTE_PREFIX = "dualfoot."


def read_bag(
    path: str | Path, *, topics: Topics | None = None, progress: Progress | None = None
) -> Recording:
    """Read the samples, the truth and the reference of a rosbag2 recording (MCAP or sqlite3).

    ``path`` is the folder of the bag, or its one .mcap or .db3 file.  A topic that is not there
    is None in the recording.  A topic named as one of pressure or of what the samples are, but of
    another type, is not read.
    ``progress`` is called with the share read, 0 to 1.

    Raises
    ------
    RecordingError
        When there is no bag, it is damaged, or a topic has another type; each names the topic
        or file and the remedy.
    """
    path = Path(path)
    topics = topics or Topics()
    raw = _read_raw(path, topics, progress)
    tables = {
        topic: messages.table(data, msgtype, topic)
        for topic, (msgtype, data) in raw.topics.items()
        if msgtype != INCREMENTS_TYPE
    }
    parts: dict[str, Any] = {}
    for foot in FEET:
        names = topics.of(foot)
        _, said = raw.topics.get(names.increments, ("", []))
        kind = decode_kind(said, names.increments)
        parts[foot] = _imu(tables.get(names.imu), tables.get(names.magnetic_field), kind)
        parts[f"{foot}_truth"] = _truth(tables.get(names.truth))
        parts[f"{foot}_frame"] = _frame(tables.get(names.imu), names.imu_frame)
    return Recording(
        **parts,
        pressure=_pressure(tables, topics),
        reference=_reference(path),
        notes=raw.notes,
        topics=topics,
        imu_topics=raw.imu_topics,
    )


class _Raw(NamedTuple):
    topics: dict[str, tuple[str, list[bytes]]]
    notes: dict[str, str]
    imu_topics: tuple[str, ...]


def _read_raw(path: Path, topics: Topics, progress: Progress | None) -> _Raw:
    expected = _expected_types(topics)
    raw: dict[str, tuple[str, list[bytes]]] = {}
    with opened(path) as reader:
        wanted = [
            c for c in reader.connections if c.topic in expected and not _has_other_type(c, topics)
        ]
        for connection in wanted:
            _check_type(connection.topic, connection.msgtype, expected[connection.topic])
            raw[connection.topic] = (connection.msgtype, [])
        total = max(1, sum(c.msgcount for c in wanted))
        for done, (topic, data) in enumerate(iterate(path, reader, wanted)):
            raw[topic][1].append(data)
            if progress is not None and done % 4096 == 0:
                progress(min(1.0, done / total))
        others = sorted({c.topic for c in reader.connections if c.msgtype == IMU_TYPE})
        return _Raw(raw, _notes(reader), tuple(others))


def _expected_types(topics: Topics) -> dict[str, str]:
    expected = {}
    for foot in FEET:
        names = topics.of(foot)
        expected[names.imu] = IMU_TYPE
        expected[names.magnetic_field] = FIELD_TYPE
        expected[names.truth] = TRUTH_TYPE
        expected[names.increments] = INCREMENTS_TYPE
    return expected | dict.fromkeys(topics.pressure.values(), PRESSURE_TYPE)


def _has_other_type(connection: Connection, topics: Topics) -> bool:
    """Return whether it has a name that anyone may use for something else, and another type."""
    free = dict.fromkeys(topics.pressure.values(), PRESSURE_TYPE)
    free |= {topics.of(foot).increments: INCREMENTS_TYPE for foot in FEET}
    return free.get(connection.topic, connection.msgtype) != connection.msgtype


def _check_type(topic: str, msgtype: str, expected: str) -> None:
    if msgtype != expected:
        raise RecordingError(f"topic '{topic}' holds {msgtype}; allowed is {expected}")


def _notes(reader: Reader) -> dict[str, str]:
    custom = reader.storage.metadata.custom
    if not isinstance(custom, dict):  # none, or damaged: the samples are what matters
        return {}
    return {
        str(key).removeprefix(NOTE_PREFIX): str(value)
        for key, value in custom.items()
        if str(key).startswith(NOTE_PREFIX)
    }


def _imu(
    imu: messages.Table | None, field: messages.Table | None, kind: Increments | None
) -> ImuSeries | None:
    if imu is None:
        return None
    magnetic = None
    if field is not None and len(field.stamp_ns):
        magnetic = _on_stamps(imu, field)
    rate, force = imu.values[:, messages.RATE], imu.values[:, messages.FORCE]
    return ImuSeries(imu.stamp_ns, force, rate, magnetic, kind)


def _on_stamps(imu: messages.Table, field: messages.Table) -> FloatArray:
    """Return the field (N, 3) at the stamps of the samples; nan where none was measured."""
    rows = np.full((len(imu.stamp_ns), 3), np.nan)
    _, at, source = np.intersect1d(imu.stamp_ns, field.stamp_ns, return_indices=True)
    rows[at] = field.values[source, :3]
    return rows


def _truth(truth: messages.Table | None) -> PoseSeries | None:
    if truth is None:
        return None
    from scipy.spatial.transform import Rotation

    quaternion, body_velocity = truth.values[:, 3:7], truth.values[:, 43:46]
    if not len(quaternion):
        return PoseSeries(truth.stamp_ns, truth.values[:, :3], quaternion, body_velocity)
    velocity = Rotation.from_quat(quaternion).apply(body_velocity)
    return PoseSeries(truth.stamp_ns, truth.values[:, :3], quaternion, velocity)


def _pressure(tables: dict[str, messages.Table], topics: Topics) -> dict[str, PressureSeries]:
    present = {worn: tables.get(topic) for worn, topic in topics.pressure.items()}
    return {
        worn: PressureSeries(table.stamp_ns, table.values[:, 0])
        for worn, table in present.items()
        if table is not None and len(table.stamp_ns)
    }


def _frame(imu: messages.Table | None, default: str) -> str:
    return (imu.texts[0] if imu is not None else "") or default


def _reference(path: Path) -> Reference | None:
    beside = (path if path.is_dir() else path.parent) / FILE_NAME
    return Reference.load(beside) if beside.exists() else None
