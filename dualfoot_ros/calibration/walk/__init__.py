"""Gyro matrices of both sensors, and the pivot of the foot, from ordinary walks."""

from .filter_terms import FilterNoise
from .foot_walk import FootWalk, foot_walk
from .gyro_matrix import GyroMatrixFit, fit_matrix
from .known_points import BeforeAndAfter, WalkErrors
from .left_out import LeftOut, leave_each_out, median_explained
from .matrix_filter import ELEMENTS
from .observability import advice, turns, weakest
from .pivot import PivotFit, fit_pivot
from .self_test import SelfTest, self_test
from .walk_calibration import (
    MISALIGNMENT,
    FootResult,
    WalkCalibration,
    calibrate_walks,
    median_of,
)

__all__ = [
    "ELEMENTS",
    "MISALIGNMENT",
    "BeforeAndAfter",
    "FilterNoise",
    "FootResult",
    "FootWalk",
    "GyroMatrixFit",
    "LeftOut",
    "PivotFit",
    "SelfTest",
    "WalkCalibration",
    "WalkErrors",
    "advice",
    "calibrate_walks",
    "fit_matrix",
    "fit_pivot",
    "foot_walk",
    "leave_each_out",
    "median_explained",
    "median_of",
    "self_test",
    "turns",
    "weakest",
]
