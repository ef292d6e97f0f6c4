"""Aids that combine with any method: what the floor, the air or the earth tells of a foot."""

from .barometer import WORN, Barometer
from .field import RANGE_T, FieldLog
from .flat_floor import FlatFloor
from .inputs import AidInputs
from .magnetic_heading import MagneticHeading
from .pressure import RANGE_PA, PressureLog, height_pressure, pressure_height
from .straight_lines import StraightLine, StraightLines

__all__ = [
    "RANGE_PA",
    "RANGE_T",
    "WORN",
    "AidInputs",
    "Barometer",
    "FieldLog",
    "FlatFloor",
    "MagneticHeading",
    "PressureLog",
    "StraightLine",
    "StraightLines",
    "height_pressure",
    "pressure_height",
]
