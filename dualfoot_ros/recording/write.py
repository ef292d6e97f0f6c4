"""Writing of recordings as rosbag2 folders, whole or not at all."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core import FEET, FloatArray, ImuSeries, IntArray, PoseSeries, RecordingError
from . import cdr
from . import message_tables as messages
from .atomic import check_target, new_directory
from .increments_topic import encode_kind
from .open_bag import METADATA
from .read import NOTE_PREFIX, Progress
from .recording import Recording
from .reference import FILE_NAME
from .storage.bag_writer import new_bag
from .topics import (
    FIELD_TYPE,
    IMU_TYPE,
    INCREMENTS_TYPE,
    PRESSURE_TYPE,
    TRUTH_TYPE,
    Topics,
)

STORAGES = ("mcap", "sqlite3")
BODY_FRAME = "base_link"
LAST_STAMP = 2**31 * 1_000_000_000  # builtin_interfaces/Time has 32-bit seconds


BLOCK = 1 << 13  # messages that are encoded at once; all of an hour would be half a gigabyte
Values = Callable[[slice], FloatArray]


class _Rows:
    """The messages of a topic as CDR bytes, encoded in blocks as they are asked for."""

    def __init__(self, stamp_ns: IntArray, values: Values, texts: tuple[str, ...]) -> None:
        """Take the stamps (N,), the values of a slice of messages, and the texts of all."""
        self._stamps, self._values, self._texts = stamp_ns, values, texts

    def __getitem__(self, part: slice) -> NDArray[np.uint8]:
        """Return (K, length) bytes of a slice of the messages."""
        return cdr.encode(self._stamps[part], self._values(part), self._texts)


class _Channel(NamedTuple):
    topic: str
    msgtype: str
    stamp_ns: IntArray
    rows: _Rows | NDArray[np.uint8]


def write_bag(
    path: str | Path,
    recording: Recording,
    *,
    storage: str = "mcap",
    overwrite: bool = False,
    topics: Topics | None = None,
    progress: Progress | None = None,
) -> Path:
    """Write ``recording`` as a rosbag2 folder ``path`` and return the path.

    Samples keep their order: a message is logged at the latest stamp so far.  What the samples are
    is logged before them, where it is known.  The reference goes
    into ``reference.yaml`` inside the folder, the notes into the bag's custom data.

    Raises
    ------
    RecordingError
        When ``path`` exists (and ``overwrite`` is not set or it is no bag), there is nothing to
        write, a stamp cannot be put into a ROS message, or ``storage`` is unknown.
    OSError
        When the folder cannot be written.  Nothing is left half-written then.
    """
    path = Path(path)
    if storage not in STORAGES:
        raise RecordingError(f"storage is '{storage}'; allowed is one of {', '.join(STORAGES)}")
    check_target(path, overwrite=overwrite, marker=METADATA)
    channels = list(_channels(recording, topics or Topics()))
    if not any(len(c.stamp_ns) for c in channels):
        raise RecordingError("there is no sample to write; give a recording of at least one foot")
    with new_directory(path, overwrite=overwrite, marker=METADATA) as folder:
        _write(folder, channels, recording, storage, progress)
        if recording.reference is not None:
            recording.reference.save(folder / FILE_NAME)
    return path


def _channels(recording: Recording, topics: Topics) -> Iterator[_Channel]:
    for foot in FEET:
        names, frame = topics.of(foot), recording.frame(foot)
        imu, truth = recording.imu(foot), recording.truth(foot)
        if imu is not None and imu.increments is not None and len(imu):
            kind = encode_kind(imu.increments)
            yield _Channel(names.increments, INCREMENTS_TYPE, imu.stamp_ns[:1], kind)
        if imu is not None:
            values = partial(_imu_values, imu)
            yield _channel(names.imu, IMU_TYPE, imu.stamp_ns, values, (frame,))
            if imu.magnetic_field is not None:
                values = partial(_first_columns, imu.magnetic_field, messages.FIELD_DOUBLES)
                yield _channel(names.magnetic_field, FIELD_TYPE, imu.stamp_ns, values, (frame,))
        if truth is not None and len(truth):
            frames = ("odom", names.foot_frame)
            values = partial(_truth_values, truth)
            yield _channel(names.truth, TRUTH_TYPE, truth.stamp_ns, values, frames)
    for worn, series in recording.pressure.items():
        column = series.pressure[:, None]  # variance 0: unknown
        values = partial(_first_columns, column, messages.PRESSURE_DOUBLES)
        frame = recording.frame(worn) if worn in FEET else BODY_FRAME
        yield _channel(topics.pressure[worn], PRESSURE_TYPE, series.stamp_ns, values, (frame,))


def _channel(
    topic: str, msgtype: str, stamp_ns: IntArray, values: Values, texts: tuple[str, ...]
) -> _Channel:
    bad = np.flatnonzero((stamp_ns < 0) | (stamp_ns >= LAST_STAMP))
    if len(bad):
        raise RecordingError(
            f"stamp {bad[0]} for topic '{topic}' is {stamp_ns[bad[0]]} ns; allowed in a ROS "
            f"message is 0 to {LAST_STAMP - 1} ns, so shift the clock first"
        )
    return _Channel(topic, msgtype, stamp_ns, _Rows(stamp_ns, values, texts))


def _first_columns(columns: FloatArray, doubles: int, part: slice) -> FloatArray:
    """Return the values of messages that begin with ``columns`` (N, K), zeros after them."""
    given = columns[part]
    values = np.zeros((len(given), doubles))
    values[:, : given.shape[1]] = given
    return values


def _imu_values(imu: ImuSeries, part: slice) -> FloatArray:
    forces, rates = imu.specific_force[part], imu.angular_rate[part]
    values = np.zeros((len(forces), messages.IMU_DOUBLES))
    values[:, 3] = 1.0
    values[:, 4] = -1.0  # REP 145: no orientation
    values[:, messages.RATE] = rates
    values[:, messages.FORCE] = forces
    return values


def _truth_values(truth: PoseSeries, part: slice) -> FloatArray:
    from scipy.spatial.transform import Rotation

    position, quaternion = truth.position[part], truth.quaternion[part]
    values = np.zeros((len(position), messages.TRUTH_DOUBLES))
    values[:, :3] = position
    values[:, 3:7] = quaternion
    if truth.velocity is not None:
        rotation = Rotation.from_quat(quaternion)
        values[:, 43:46] = rotation.apply(truth.velocity[part], inverse=True)
    return values


def _write(
    folder: Path,
    channels: list[_Channel],
    recording: Recording,
    storage: str,
    progress: Progress | None,
) -> None:
    custom = {NOTE_PREFIX + key: str(value) for key, value in recording.notes.items()}
    with new_bag(folder, storage, custom) as writer:
        keys = [
            writer.add_topic(c.topic, c.msgtype, latched_depth=int(c.msgtype == INCREMENTS_TYPE))
            for c in channels
        ]
        logged, which = _in_order(channels)
        done = [0] * len(channels)  # rows of each channel that are written
        for start in range(0, len(logged), BLOCK):
            part = slice(start, start + BLOCK)
            writer.write_many(keys, which[part], logged[part], _next(channels, which[part], done))
            if progress is not None:
                progress(start / len(logged))


def _in_order(channels: list[_Channel]) -> tuple[IntArray, IntArray]:
    """Return log time and channel of every message, in the order of the log times.

    The messages of a channel keep their order.
    """
    logged = np.concatenate([np.maximum.accumulate(c.stamp_ns) for c in channels])
    which = np.concatenate([np.full(len(c.stamp_ns), k) for k, c in enumerate(channels)])
    order = np.argsort(logged, kind="stable")
    return logged[order], which[order]


def _next(channels: list[_Channel], which: IntArray, done: list[int]) -> list[bytes]:
    """Return the next message of each channel in ``which`` (K,), and count it in ``done``."""
    upcoming = []
    counts = np.bincount(which, minlength=len(channels)).tolist()
    for place, (channel, count) in enumerate(zip(channels, counts, strict=True)):
        rows = channel.rows[done[place] : done[place] + count]
        done[place] += count
        whole = np.ascontiguousarray(rows).view(f"V{rows.shape[1]}")[:, 0]
        upcoming.append(iter(whole.tolist()))
    return [next(upcoming[place]) for place in which.tolist()]
