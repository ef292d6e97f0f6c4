"""Air pressure: its height in the standard atmosphere, and what has been measured of it lately.

Pressure becomes height by the troposphere of the ICAO Standard Atmosphere (Doc 7488):
h = T0 / L ((p0 / p)^(R L / g) - 1) with T0 = 288.15 K, L = -6.5 K/km, p0 = 101 325 Pa.  Only
differences of it are used here, over which the true temperature matters by its ratio to T0.
"""

from __future__ import annotations

from ..refusals import Refusal
from .log import Log

SEA_LEVEL_PA = 101325.0
SCALE_M = 288.15 / 0.0065
EXPONENT = 0.190263
RANGE_PA = (1e4, 2e5)  # beyond these it is no air a person breathes, or not in Pa


def pressure_height(pascal: float) -> float:
    """Return the height in m above the 101 325 Pa level of the ICAO Standard Atmosphere."""
    height_m: float = SCALE_M * (1.0 - float(pascal / SEA_LEVEL_PA) ** EXPONENT)
    return height_m


def height_pressure(height_m: float) -> float:
    """Return the pressure in Pa at a height in m of the ICAO Standard Atmosphere."""
    pascal: float = SEA_LEVEL_PA * float(1.0 - height_m / SCALE_M) ** (1.0 / EXPONENT)
    return pascal


class PressureLog(Log[float]):
    """What one sensor has measured: heights in m over time."""

    def add(self, stamp_ns: int, pascal: float) -> Refusal | None:
        """Take a sample; return why it is refused, if it is."""
        if not RANGE_PA[0] < pascal < RANGE_PA[1]:
            return Refusal.PRESSURE_OUT_OF_RANGE
        taken = self.put(stamp_ns, pressure_height(pascal))
        return None if taken else Refusal.PRESSURE_OUT_OF_ORDER
