"""A person carried by the floor: lift, vehicle, moving walkway, escalator."""

from .boarding import Boarding
from .carriage import Carriage
from .ground import Ground

__all__ = ["Boarding", "Carriage", "Ground"]
