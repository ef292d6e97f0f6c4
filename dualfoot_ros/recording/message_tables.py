"""Messages of one topic as arrays: fast where all have one layout, one by one where not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..core import FloatArray, IntArray, RecordingError
from . import cdr
from .topics import FIELD_TYPE, IMU_TYPE, PRESSURE_TYPE, TRUTH_TYPE

IMU_DOUBLES = 37  # orientation, its covariance, rate, covariance, specific force, covariance
FIELD_DOUBLES = 12  # field, its covariance
PRESSURE_DOUBLES = 2  # pressure, its variance
TRUTH_DOUBLES = 85  # pose (3 + 4), covariance (36), twist (3 + 3), covariance (36)
RATE = slice(13, 16)
FORCE = slice(25, 28)


@dataclass(frozen=True)
class Table:
    """All messages of one topic: stamps (N,) ns, values (N, doubles), strings of the first."""

    stamp_ns: IntArray
    values: FloatArray
    texts: list[str]


def table(messages: list[bytes], msgtype: str, topic: str) -> Table:
    """Decode all ``messages`` of ``topic``, which are of ``msgtype``.

    Raises
    ------
    RecordingError
        When a message cannot be decoded; names the topic and which message it is.
    """
    doubles, texts = _LAYOUT[msgtype]
    if not messages:
        return Table(np.empty(0, dtype=np.int64), np.empty((0, doubles)), [""] * texts)
    fast = cdr.decode(messages, doubles, texts)
    return Table(*fast) if fast is not None else _one_by_one(messages, msgtype, topic)


def _one_by_one(messages: list[bytes], msgtype: str, topic: str) -> Table:
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    stamps = np.empty(len(messages), dtype=np.int64)
    values = np.empty((len(messages), _LAYOUT[msgtype][0]))
    texts: list[str] = []
    for i, data in enumerate(messages):
        try:
            message = store.deserialize_cdr(data, msgtype)
        except Exception as error:  # the decoder raises whatever the broken bytes lead to
            raise RecordingError(
                f"message {i} of topic '{topic}' is damaged ({type(error).__name__}); "
                "record again or cut the bag before it"
            ) from error
        stamp = message.header.stamp  # type: ignore[attr-defined]
        stamps[i] = stamp.sec * 1_000_000_000 + stamp.nanosec
        values[i] = _FLAT[msgtype](message)
        texts = texts or _texts(message)
    return Table(stamps, values, texts)


def _texts(message: Any) -> list[str]:
    child = [message.child_frame_id] if hasattr(message, "child_frame_id") else []
    return [message.header.frame_id, *child]


def _imu(m: Any) -> FloatArray:
    q, w, f = m.orientation, m.angular_velocity, m.linear_acceleration
    return np.concatenate(
        [
            (q.x, q.y, q.z, q.w),
            m.orientation_covariance,
            (w.x, w.y, w.z),
            m.angular_velocity_covariance,
            (f.x, f.y, f.z),
            m.linear_acceleration_covariance,
        ]
    )


def _field(m: Any) -> FloatArray:
    b = m.magnetic_field
    return np.concatenate([(b.x, b.y, b.z), m.magnetic_field_covariance])


def _pressure(m: Any) -> FloatArray:
    return np.array([m.fluid_pressure, m.variance])


def _truth(m: Any) -> FloatArray:
    p, q = m.pose.pose.position, m.pose.pose.orientation
    v, w = m.twist.twist.linear, m.twist.twist.angular
    return np.concatenate(
        [
            (p.x, p.y, p.z, q.x, q.y, q.z, q.w),
            m.pose.covariance,
            (v.x, v.y, v.z, w.x, w.y, w.z),
            m.twist.covariance,
        ]
    )


_FLAT = {IMU_TYPE: _imu, FIELD_TYPE: _field, PRESSURE_TYPE: _pressure, TRUTH_TYPE: _truth}
_LAYOUT = {
    IMU_TYPE: (IMU_DOUBLES, 1),
    FIELD_TYPE: (FIELD_DOUBLES, 1),
    PRESSURE_TYPE: (PRESSURE_DOUBLES, 1),
    TRUTH_TYPE: (TRUTH_DOUBLES, 2),
}
