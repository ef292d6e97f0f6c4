"""The constraint methods, and all that is needed to write another one."""

from ..joint_estimate import JointEstimate, Outcome, nothing_done, relative_row
from ..kernel.layout import attitude_row, gyro_bias_row, position_row, velocity_row
from ..results.payloads import Details, DistanceLimit, Passing, Reason
from .method import Gait, Method, Request, StancePhase
from .method_registry import ENTRY_POINTS, METHODS, MethodRegistry

__all__ = [
    "ENTRY_POINTS",
    "METHODS",
    "Details",
    "DistanceLimit",
    "Gait",
    "JointEstimate",
    "Method",
    "MethodRegistry",
    "Outcome",
    "Passing",
    "Reason",
    "Request",
    "StancePhase",
    "attitude_row",
    "gyro_bias_row",
    "nothing_done",
    "position_row",
    "relative_row",
    "velocity_row",
]
