"""The navigation itself: no I/O, no logging, no clock, no global state."""

from .config import TrackerConfig
from .errors import AlignmentError, ConfigError, DualFootError, SeriesError
from .series import ImuPair, ImuSeries, PoseSeries
from .trajectory import Event, EventKind, FootTrajectory, Trajectory

__all__ = [
    "AlignmentError",
    "ConfigError",
    "DualFootError",
    "Event",
    "EventKind",
    "FootTrajectory",
    "ImuPair",
    "ImuSeries",
    "PoseSeries",
    "SeriesError",
    "Trajectory",
    "TrackerConfig",
]
