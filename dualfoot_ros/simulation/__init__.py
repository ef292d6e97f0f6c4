"""A walk generator with exact analytic truth, for tests, demonstrations and sweeps."""

from ..core import SimulationError
from .air_pressure import BarometerConfig
from .clocks import ClockConfig
from .floors import MovingFloorConfig, on_moving_floor
from .magnetometer import MagnetometerConfig
from .routes import ROUTES, Route, route
from .sensors import GRADES, SensorConfig, grade
from .simulate import Simulation, simulate
from .summary import summary
from .walk import Walk, rigid_pair, walk
from .walk_config import MOUNTS, Gait, WalkConfig

__all__ = [
    "GRADES",
    "MOUNTS",
    "ROUTES",
    "BarometerConfig",
    "ClockConfig",
    "Gait",
    "MagnetometerConfig",
    "MovingFloorConfig",
    "Route",
    "SensorConfig",
    "Simulation",
    "SimulationError",
    "Walk",
    "WalkConfig",
    "grade",
    "on_moving_floor",
    "rigid_pair",
    "route",
    "simulate",
    "summary",
    "walk",
]
