"""Air pressure: its height in the standard atmosphere, and what has been measured of it lately.

Pressure becomes height by the troposphere of the ICAO Standard Atmosphere (Doc 7488):
h = T0 / L ((p0 / p)^(R L / g) - 1) with T0 = 288.15 K, L = -6.5 K/km, p0 = 101 325 Pa.  Only
differences of it are used here, over which the true temperature matters by its ratio to T0.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right

SEA_LEVEL_PA = 101325.0
SCALE_M = 288.15 / 0.0065
EXPONENT = 0.190263
RANGE_PA = (1e4, 2e5)  # beyond these it is no air a person breathes, or not in Pa
KEEP_NS = 60_000_000_000
TIME_JUMP_NS = 1_000_000_000  # further back than this is a new recording, not disorder


def pressure_height(pascal: float) -> float:
    """Return the height in m above the 101 325 Pa level of the ICAO Standard Atmosphere."""
    return SCALE_M * (1.0 - float(pascal / SEA_LEVEL_PA) ** EXPONENT)


def height_pressure(height_m: float) -> float:
    """Return the pressure in Pa at a height in m of the ICAO Standard Atmosphere."""
    return SEA_LEVEL_PA * float(1.0 - height_m / SCALE_M) ** (1.0 / EXPONENT)


class PressureLog:
    """What one sensor has measured: heights over time."""

    def __init__(self) -> None:
        """Start with nothing measured."""
        self._stamps: list[int] = []
        self._heights: list[float] = []

    def add(self, stamp_ns: int, pascal: float) -> str | None:
        """Take a sample; return the name of why not, if it is refused.

        A stamp far before the newest one begins a new recording: what came before is forgotten.
        """
        if not RANGE_PA[0] < pascal < RANGE_PA[1]:
            return "pressure_out_of_range"
        if self._stamps and stamp_ns <= self._stamps[-1]:
            if self._stamps[-1] - stamp_ns < TIME_JUMP_NS:
                return "pressure_out_of_order"
            self._stamps.clear()
            self._heights.clear()
        self._stamps.append(stamp_ns)
        self._heights.append(pressure_height(pascal))
        return None

    def trim(self) -> None:
        """Forget what is too old to be asked for, now and then."""
        newest = self._stamps[-1] if self._stamps else 0
        if self._stamps and newest - self._stamps[0] > 2 * KEEP_NS:
            old = bisect_left(self._stamps, newest - KEEP_NS)
            del self._stamps[:old], self._heights[:old]

    def between(self, first_ns: int, last_ns: int) -> list[float]:
        """Return the heights in m from ``first_ns`` to ``last_ns``, both included."""
        first, stop = bisect_left(self._stamps, first_ns), bisect_right(self._stamps, last_ns)
        return self._heights[first:stop]
