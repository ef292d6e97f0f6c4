"""The items of a message of the Xbus protocol: what they are called, and what they say."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from ...core import Increments
from ..sample import scaled
from .delta import per_second, rotation_vector

PACKET_COUNTER, SAMPLE_TIME_FINE, TEMPERATURE = 0x1020, 0x1060, 0x0810
ACCELERATION, ACCELERATION_HR = 0x4020, 0x4040
RATE_OF_TURN, RATE_OF_TURN_HR = 0x8020, 0x8040
MAGNETIC_FIELD = 0xC020
DELTA_V, DELTA_Q = 0x4010, 0x8030
MOTION = {  # number of values
    ACCELERATION: 3,
    ACCELERATION_HR: 3,
    RATE_OF_TURN: 3,
    RATE_OF_TURN_HR: 3,
    DELTA_V: 3,
    DELTA_Q: 4,
}
KIND, PRECISION = 0xFFF0, 0x3
SIZES = (4, 4, 6, 8)  # bytes of a float, of fixed-point 12.20 and 16.32, of a double

Items = dict[int, tuple[int, bytes]]
Motion = tuple[tuple[float, ...], tuple[float, ...], Increments | None]


def items_of(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield identifier and value of each item of the data of an MTData2 message."""
    at = 0
    while at + 3 <= len(content):
        size = content[at + 2]
        yield int.from_bytes(content[at : at + 2], "big"), content[at + 3 : at + 3 + size]
        at += 3 + size


def read_increments(items: Items, interval_s: float | None) -> Motion | None:
    """Return force and rate of the increments; None without them or before the interval is known.

    DeltaV needs no turning back: the maker's acceleration is DeltaV per second.
    """
    quaternion, push = read_reals(items, DELTA_Q, 4), read_reals(items, DELTA_V, 3)
    if quaternion is None or push is None or interval_s is None:
        return None
    rotation = rotation_vector(quaternion)
    if rotation is None:
        return None
    force = scaled(push, 1.0 / interval_s)
    return force, per_second(rotation, interval_s), Increments.COMPENSATED


def read_motion(items: Items) -> Motion | None:
    """Return force and rate, calibrated where they are sent, else of the high-rate outputs."""
    calibrated = read_reals(items, ACCELERATION, 3), read_reals(items, RATE_OF_TURN, 3)
    high = read_reals(items, ACCELERATION_HR, 3), read_reals(items, RATE_OF_TURN_HR, 3)
    force, rate = calibrated[0] or high[0], calibrated[1] or high[1]
    if force is None or rate is None:
        return None
    if (force, rate) == calibrated:
        return force, rate, Increments.COMPENSATED
    return force, rate, Increments.SAMPLED if (force, rate) == high else None


def read_force(items: Items) -> tuple[float, ...] | None:
    """Return a force without a rate, calibrated where it is sent."""
    return read_reals(items, ACCELERATION, 3) or read_reals(items, ACCELERATION_HR, 3)


def read_rate(items: Items) -> tuple[tuple[float, ...] | None, Increments | None]:
    """Return a rate without a force, and what it is beside one interpolated to its stamp.

    That force is no increment any more, so only samples of the signal keep their kind.
    """
    high = read_reals(items, RATE_OF_TURN_HR, 3)
    rate = read_reals(items, RATE_OF_TURN, 3) or high
    return rate, Increments.SAMPLED if rate is not None and rate is high else None


def read_whole(items: Items, key: int, size: int) -> int | None:
    """Return the whole number of an item of ``size`` bytes; None where it is none."""
    _, value = items.get(key, (0, b""))
    return int.from_bytes(value, "big") if len(value) == size else None


def read_reals(items: Items, key: int, count: int) -> tuple[float, ...] | None:
    """Return the ``count`` numbers of an item, or None where it is absent or too short."""
    if key not in items:
        return None
    precision, value = items[key]
    size = SIZES[precision]
    if len(value) != count * size:
        return None
    return tuple(_read_real(precision, value[k : k + size]) for k in range(0, len(value), size))


def _read_real(precision: int, value: bytes) -> float:
    if precision == 1:
        return int.from_bytes(value, "big", signed=True) / (1 << 20)
    if precision == 2:  # the fraction, 32 bits, is sent before the whole part, 16 bits
        return int.from_bytes(value[4:] + value[:4], "big", signed=True) / (1 << 32)
    return float(struct.unpack(">f" if precision == 0 else ">d", value)[0])
