"""A time that follows another one smoothly: continuous, strictly increasing, never a step."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

SEGMENTS = 64


class Segment(NamedTuple):
    """From ``device_ns`` on: host = host_ns + elapsed (1 + excess)."""

    device_ns: int
    host_ns: int
    excess: float

    def at(self, device_ns: int) -> int:
        """Return the host time of ``device_ns``, ns."""
        elapsed = device_ns - self.device_ns
        return self.host_ns + elapsed + round(self.excess * elapsed)


class SlewedTime:
    """Device time to host time by straight pieces that meet.

    Every piece rises, so stamps 2 ns apart or more never come out in another order.  The last
    pieces are kept, so a sample that comes late is stamped as it would have been in time.
    """

    def __init__(self, device_ns: int, host_ns: int, skew: float = 0.0) -> None:
        self._segments = deque([Segment(device_ns, host_ns, skew)], maxlen=SEGMENTS)

    @property
    def newest(self) -> Segment:
        """The piece that goes on into the future."""
        return self._segments[-1]

    def at(self, device_ns: int) -> int:
        """Return the host time of ``device_ns``, ns."""
        for segment in reversed(self._segments):
            if segment.device_ns <= device_ns:
                return segment.at(device_ns)
        return self._segments[0].at(device_ns)

    def steer(self, device_ns: int, skew: float, correction: float) -> None:
        """Run at ``skew`` plus ``correction`` from ``device_ns`` on, not before the newest piece.

        Both are ratios, above -0.6 together.
        """
        host_ns = self.newest.at(device_ns)
        self._segments.append(Segment(device_ns, host_ns, max(skew + correction, -0.6)))
