"""Aids that combine with any method: what the floor or the air tells about a standing foot."""

from .barometer import Barometer, pressure_height
from .flat_floor import FlatFloor

__all__ = ["Barometer", "FlatFloor", "pressure_height"]
