"""Sample of an inertial sensor, in SI units whatever the device sends."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..core import Increments, Vector


class Sample(NamedTuple):
    """One measurement of the device, decoded.

    Attributes
    ----------
    arrival_ns : int
        Nanoseconds of the host's wall clock (``time.time_ns``) when the bytes that completed the
        sample were read.  Samples that came in one chunk share it.
    specific_force : (3,) m/s^2
        Reading of the accelerometer: +g along the axis that points up when at rest.
    angular_rate : (3,) rad/s
    ticks : int or None
        Raw device time as sent, still wrapping; None when the device sends no time.
    tick_ns : int
        Nominal length of one tick in nanoseconds.
    tick_bits : int
        Width of the device's tick counter, for the unwrapper.
    temperature : float or None
        Degrees Celsius, the latest the device has sent.
    magnetic_field : (3,) T, or None
        The latest the device has sent, where its unit is known.
    counter : int or None
        Raw packet counter as sent.
    increments : Increments or None
        What rate and force say about their interval; None when the device does not tell.
    """

    arrival_ns: int
    specific_force: Vector
    angular_rate: Vector
    ticks: int | None = None
    tick_ns: int = 1000
    tick_bits: int = 64
    temperature: float | None = None
    magnetic_field: Vector | None = None
    counter: int | None = None
    increments: Increments | None = None


def is_finite(*vectors: Vector) -> bool:
    """Return whether every component of every vector is a finite number."""
    return all(math.isfinite(value) for vector in vectors for value in vector)


def scaled(vector: tuple[float, ...], factor: float) -> Vector:
    """Return the (3,) vector times ``factor``."""
    x, y, z = vector
    return (x * factor, y * factor, z * factor)
