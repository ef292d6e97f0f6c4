"""Reading of rosbag2 recordings into arrays."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core import (
    FEET,
    FloatArray,
    ImuSeries,
    Increments,
    IntArray,
    PoseSeries,
    PressureSeries,
    RecordingError,
    quaternion_matrices,
    rotate_each,
)
from . import message_tables as messages
from .increments_topic import decode_kind
from .open_bag import iterate, opened
from .recording import Recording
from .reference import FILE_NAME, Reference
from .split_topics import Samples, join
from .storage.bag_source import BagSource
from .topics import (
    FIELD_TYPE,
    IMU_TYPE,
    INCREMENTS_TYPE,
    PRESSURE_TYPE,
    TRUTH_TYPE,
    VECTOR_TYPE,
    FootTopics,
    Topics,
)

Progress = Callable[[float], None]
NOTE_PREFIX = "dualfoot."


def read_bag(
    path: str | Path, *, topics: Topics | None = None, progress: Progress | None = None
) -> Recording:
    """Read the samples, the truth and the reference of a recording (MCAP, sqlite3, ROS 1).

    ``path`` is the folder of the bag, or its one .mcap, .db3 or .bag file.  Of a bag that was cut
    off the part that is there is read, and ``Recording.cut`` says so.  A topic that is not there
    is None in the recording.  A topic named as one of pressure or of what the samples are, but of
    another type, is not read.
    ``progress`` is called with the share read, 0 to 1.

    Raises
    ------
    RecordingError
        When there is no bag, nothing of it can be read, or a topic has another type; each names
        the topic or file and the remedy.
    """
    return read_logged(path, topics=topics, progress=progress)[0]


def read_logged(
    path: str | Path, *, topics: Topics | None = None, progress: Progress | None = None
) -> tuple[Recording, dict[str, IntArray]]:
    """Return the recording of a bag, and the log times (N,) ns of the samples of each foot.

    Raises as :func:`read_bag`.
    """
    path = Path(path)
    topics = topics or Topics()
    raw = _read_raw(path, topics, progress)
    tables = {topic: raw.tables.pop(topic).table() for topic in list(raw.tables)}
    parts: dict[str, Any] = {}
    logged: dict[str, IntArray] = {}
    for foot in FEET:
        names = topics.of(foot)
        samples = _samples(tables, names, _kind(raw, names.increments))
        parts[foot] = None if samples is None else samples.series
        logged[foot] = np.empty(0, dtype=np.int64) if samples is None else samples.log_ns
        parts[f"{foot}_truth"] = _truth(tables.get(names.truth))
        parts[f"{foot}_frame"] = _frame(tables.get(names.imu), names.imu_frame)
    recording = Recording(
        **parts,
        pressure=_pressure(tables, topics),
        reference=_reference(path),
        notes=raw.notes,
        topics=topics,
        imu_topics=raw.imu_topics,
        cut=raw.cut,
    )
    return recording, logged


class _Raw(NamedTuple):
    """What a bag holds: values by topic, the newest text by topic, and what it says of itself."""

    tables: dict[str, messages.TableBuilder]
    texts: dict[str, list[bytes]]
    notes: dict[str, str]
    imu_topics: tuple[str, ...]
    cut: str


def _read_raw(path: Path, topics: Topics, progress: Progress | None) -> _Raw:
    expected = _expected_types(topics)
    with opened(path) as source:
        types = {
            topic: msgtype
            for topic, (msgtype, _) in source.topics.items()
            if topic in expected and not _has_other_type(topic, msgtype, topics)
        }
        for topic, msgtype in types.items():
            _check_type(topic, msgtype, expected[topic])
        others = sorted(t for t, info in source.topics.items() if info.msgtype == IMU_TYPE)
        raw = _Raw({}, {}, _notes(source), tuple(others), "")
        for topic, msgtype in types.items():
            if msgtype == INCREMENTS_TYPE:
                raw.texts[topic] = []
            else:
                expected_count = max(0, source.topics[topic].messages)
                raw.tables[topic] = messages.TableBuilder(msgtype, topic, expected_count)
        _take_messages(path, source, raw, progress)
        return raw._replace(cut=source.cut)


def _take_messages(path: Path, source: BagSource, raw: _Raw, progress: Progress | None) -> None:
    """Read the messages of all topics of ``raw`` into it."""
    wanted = {*raw.tables, *raw.texts}
    total = max(1, sum(source.topics[topic].messages for topic in wanted))
    done = 0
    for block in iterate(path, source, wanted):
        if block.topic in raw.tables:
            raw.tables[block.topic].add(block)
        else:
            raw.texts[block.topic][:] = [bytes(block.rows[-1])]
        done += len(block.log_ns)
        if progress is not None:
            progress(min(1.0, done / total))


def _expected_types(topics: Topics) -> dict[str, tuple[str, ...]]:
    expected: dict[str, tuple[str, ...]] = {}
    for foot in FEET:
        names = topics.of(foot)
        expected[names.imu] = (IMU_TYPE,)
        if names.force:
            expected |= dict.fromkeys((names.imu, names.force), (IMU_TYPE, VECTOR_TYPE))
        expected[names.magnetic_field] = (FIELD_TYPE,)
        expected[names.truth] = (TRUTH_TYPE,)
        expected[names.increments] = (INCREMENTS_TYPE,)
    return expected | dict.fromkeys(topics.pressure.values(), (PRESSURE_TYPE,))


def _has_other_type(topic: str, msgtype: str, topics: Topics) -> bool:
    """Return whether it has a name that anyone may use for something else, and another type."""
    free = dict.fromkeys(topics.pressure.values(), PRESSURE_TYPE)
    free |= {topics.of(foot).increments: INCREMENTS_TYPE for foot in FEET}
    return free.get(topic, msgtype) != msgtype


def _check_type(topic: str, msgtype: str, expected: tuple[str, ...]) -> None:
    if msgtype not in expected:
        allowed = " or ".join(expected)
        raise RecordingError(f"topic '{topic}' holds {msgtype}; allowed is {allowed}")


def _notes(source: BagSource) -> dict[str, str]:
    return {
        key.removeprefix(NOTE_PREFIX): value
        for key, value in source.custom.items()
        if key.startswith(NOTE_PREFIX)
    }


def _kind(raw: _Raw, topic: str) -> Increments | None:
    return decode_kind(raw.texts[topic], topic) if topic in raw.texts else None


def _samples(
    tables: dict[str, messages.Table], names: FootTopics, kind: Increments | None
) -> Samples | None:
    """Return the samples of a foot, of one topic or of two; None where a topic is missing."""
    imu, field = tables.get(names.imu), tables.get(names.magnetic_field)
    if imu is None:
        return None
    magnetic = None
    if names.force:
        force = tables.get(names.force)
        return None if force is None else join(imu, force, kind)
    if field is not None and len(field.stamp_ns):
        magnetic = _on_stamps(imu, field)
    return Samples(ImuSeries(imu.stamp_ns, imu.force, imu.rate, magnetic, kind), imu.log_ns)


def _on_stamps(imu: messages.Table, field: messages.Table) -> FloatArray:
    """Return the field (N, 3) at the stamps of the samples; nan where none was measured."""
    rows = np.full((len(imu.stamp_ns), 3), np.nan)
    _, at, source = np.intersect1d(imu.stamp_ns, field.stamp_ns, return_indices=True)
    rows[at] = field.parts[0][source]
    return rows


def _truth(truth: messages.Table | None) -> PoseSeries | None:
    if truth is None:
        return None
    pose, body_velocity = truth.parts
    position, quaternion = pose[:, :3], pose[:, 3:]
    if not len(quaternion):
        return PoseSeries(truth.stamp_ns, position, quaternion, body_velocity)
    velocity = rotate_each(body_velocity, quaternion_matrices(quaternion))
    return PoseSeries(truth.stamp_ns, position, quaternion, velocity)


def _pressure(tables: dict[str, messages.Table], topics: Topics) -> dict[str, PressureSeries]:
    present = {worn: tables.get(topic) for worn, topic in topics.pressure.items()}
    return {
        worn: PressureSeries(table.stamp_ns, table.parts[0][:, 0])
        for worn, table in present.items()
        if table is not None and len(table.stamp_ns)
    }


def _frame(imu: messages.Table | None, default: str) -> str:
    return (imu.texts[0] if imu is not None else "") or default


def _reference(path: Path) -> Reference | None:
    beside = (path if path.is_dir() else path.parent) / FILE_NAME
    return Reference.load(beside) if beside.exists() else None
