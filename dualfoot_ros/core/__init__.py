"""The navigation itself: no I/O, no logging, no clock, no global state."""

from .config import TrackerConfig
from .errors import AlignmentError, ConfigError, DualFootError, SeriesError
from .results.trajectory import Event, EventKind, FootTrajectory, Trajectory
from .results.update import Update
from .samples.series import FieldSeries, ImuPair, ImuSeries, PoseSeries, PressureSeries
from .tracker import DualFootTracker

__all__ = [
    "AlignmentError",
    "ConfigError",
    "DualFootError",
    "DualFootTracker",
    "Event",
    "EventKind",
    "FieldSeries",
    "FootTrajectory",
    "ImuPair",
    "ImuSeries",
    "PoseSeries",
    "PressureSeries",
    "SeriesError",
    "TrackerConfig",
    "Trajectory",
    "Update",
]
