"""Increments of attitude and velocity, as devices send them, turned into rates and forces.

A device that compensates coning and sculling integrates at its inner clock and sends what an
interval has turned and pushed.  The rate and force here, held over the interval, do the same.
"""

from __future__ import annotations

import math
from collections import deque

from ...core import Vector
from ..sample import scaled

REMEMBERED = 16  # intervals
LONGEST_NS = 1_000_000_000
SMALL_RAD = 1e-2  # below which a series is exact


class OutputInterval:
    """Interval between two outputs of a device, from its own ticks: the shortest of the last few.

    A lost message makes an interval twice as long, but none makes it shorter.
    """

    def __init__(self, tick_ns: int, bits: int) -> None:
        """Take ticks of ``tick_ns`` ns from a counter of ``bits`` bits."""
        self._tick_ns, self._modulus = tick_ns, 1 << bits
        self.reset()

    def reset(self) -> None:
        """Forget what was seen, because the link was lost."""
        self._last: int | None = None
        self._steps: deque[int] = deque(maxlen=REMEMBERED)

    def add(self, ticks: int) -> None:
        """Take the ticks of the next output."""
        if self._last is not None:
            step_ns = (ticks - self._last) % self._modulus * self._tick_ns
            if 0 < step_ns <= LONGEST_NS:
                self._steps.append(step_ns)
        self._last = ticks

    @property
    def count(self) -> int:
        """Number of intervals that are remembered."""
        return len(self._steps)

    @property
    def seconds(self) -> float | None:
        """The interval in s, None before the second output."""
        return min(self._steps) * 1e-9 if self._steps else None


def rotation_vector(quaternion: tuple[float, ...]) -> Vector | None:
    """Return the rotation (3,) rad of a quaternion w x y z; None where it has no length."""
    w, x, y, z = quaternion
    size = math.sqrt(x * x + y * y + z * z)
    if not math.isfinite(size) or size + abs(w) == 0.0:
        return None
    if w < 0.0:  # the other quaternion of the same rotation, with the smaller angle
        w, x, y, z = -w, -x, -y, -z
    factor = 2.0 * math.atan2(size, w) / size if size > 0.0 else 0.0
    return (factor * x, factor * y, factor * z)


def held_push(alpha: Vector, push: Vector) -> Vector:
    """Return the force times the interval (3,) m/s, constant in a body that turns by ``alpha``.

    ``push`` (3,) m/s is the change of velocity it makes, in the axes at the start:
    gamma = v - alpha x v / 2 + e alpha x (alpha x v), e = (1 - (a / 2) cot(a / 2)) / a^2.
    """
    half = 0.5 * math.sqrt(sum(a * a for a in alpha))
    if half < SMALL_RAD:
        e = (1.0 + half * half / 15.0) / 12.0
    else:
        e = (1.0 - half / math.tan(half)) / (4.0 * half * half)
    once = cross(alpha, push)
    twice = cross(alpha, once)
    x, y, z = (v - 0.5 * c + e * d for v, c, d in zip(push, once, twice, strict=True))
    return (x, y, z)


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product (3,)."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def per_second(increment: Vector, interval_s: float) -> Vector:
    """Return an increment (3,) divided by its interval."""
    return scaled(increment, 1.0 / interval_s)
