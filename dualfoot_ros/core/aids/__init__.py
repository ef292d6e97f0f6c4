"""Aids that combine with any method: what the floor or the air tells about a standing foot."""

from .barometer import WORN, Barometer
from .flat_floor import FlatFloor
from .pressure import PressureLog, height_pressure, pressure_height

__all__ = [
    "WORN",
    "Barometer",
    "FlatFloor",
    "PressureLog",
    "height_pressure",
    "pressure_height",
]
