"""The navigation itself: no I/O, no logging, no clock, no global state."""

from .alignment import stillness
from .config import GROUPS, TrackerConfig, all_specs, method_parameters, nested
from .config_groups import AlignmentConfig, IncrementsConfig, NoiseConfig
from .constraints import METHODS
from .errors import (
    AlignmentError,
    CalibrationError,
    ConfigError,
    DualFootError,
    EvaluationError,
    RecordingError,
    SeriesError,
    SimulationError,
    SourceError,
    TimingError,
)
from .parameters import Parameters, ParameterSpec, check, parameter
from .refusals import Refusal, refusal_of
from .results.events import FEET, Event, EventKind
from .results.passings import (
    MID_STANCE,
    StanceEpochs,
    StancePassing,
    SwingPassings,
    stance_passings,
    swing_passings,
)
from .results.payloads import Details, DistanceLimit, Passing, Reason, YawTurn
from .results.rows import clean_stance, to_trajectory, turn_rows
from .results.trajectory import FootTrajectory, Trajectory, stance_bounds, stance_middles
from .results.update import FootEstimate, PedestrianEstimate, Update
from .rotation import (
    about_z,
    mean_angle,
    quaternion_matrix,
    quaternion_yaw,
    turn_quaternions,
    yaw_quaternion,
)
from .samples.increments import Increments
from .samples.mounting import (
    FORWARD_LEFT_UP,
    IDENTITY,
    RIGHT_FRONT_UP,
    Matrix,
    MountingConfig,
    Vector,
    axes_matrix,
    dot,
)
from .samples.series import (
    BoolArray,
    FieldSeries,
    FloatArray,
    ImuPair,
    ImuSeries,
    IntArray,
    PoseSeries,
    PressureSeries,
)
from .samples.units import DEGREE, FORCE_UNITS, RATE_UNITS, STANDARD_GRAVITY
from .tracker import DualFootTracker, fields_of

__all__ = [
    "DEGREE",
    "FEET",
    "FORCE_UNITS",
    "FORWARD_LEFT_UP",
    "GROUPS",
    "IDENTITY",
    "METHODS",
    "MID_STANCE",
    "RATE_UNITS",
    "RIGHT_FRONT_UP",
    "STANDARD_GRAVITY",
    "AlignmentConfig",
    "AlignmentError",
    "BoolArray",
    "CalibrationError",
    "ConfigError",
    "Details",
    "DistanceLimit",
    "DualFootError",
    "DualFootTracker",
    "EvaluationError",
    "Event",
    "EventKind",
    "FieldSeries",
    "FloatArray",
    "FootEstimate",
    "FootTrajectory",
    "ImuPair",
    "ImuSeries",
    "Increments",
    "IncrementsConfig",
    "IntArray",
    "Matrix",
    "MountingConfig",
    "NoiseConfig",
    "ParameterSpec",
    "Parameters",
    "Passing",
    "PedestrianEstimate",
    "PoseSeries",
    "PressureSeries",
    "Reason",
    "RecordingError",
    "Refusal",
    "SeriesError",
    "SimulationError",
    "SourceError",
    "StanceEpochs",
    "StancePassing",
    "SwingPassings",
    "TimingError",
    "TrackerConfig",
    "Trajectory",
    "Update",
    "Vector",
    "YawTurn",
    "about_z",
    "all_specs",
    "axes_matrix",
    "check",
    "clean_stance",
    "dot",
    "fields_of",
    "mean_angle",
    "method_parameters",
    "nested",
    "parameter",
    "quaternion_matrix",
    "quaternion_yaw",
    "refusal_of",
    "stance_bounds",
    "stance_middles",
    "stance_passings",
    "stillness",
    "swing_passings",
    "to_trajectory",
    "turn_quaternions",
    "turn_rows",
    "yaw_quaternion",
]
