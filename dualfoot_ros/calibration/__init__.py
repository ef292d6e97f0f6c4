"""Calibration of sensors and gait from recordings made for it, or from walks, and its files."""

from typing import TYPE_CHECKING

from ..lazy_face import lazy_face
from .parameter_text import parameter_text

if TYPE_CHECKING:
    from ..core import CalibrationError
    from .accelerometer import MODELS, AccelerometerFit, fit_accelerometer, rms, why_not
    from .bias_memory import BiasMemory, RememberedStand, stands_in, stands_of
    from .cross_validation import CrossValidation, cross_validate
    from .feet import calibrated, for_feet, sensor_calibration
    from .file import ANY, Calibration
    from .gyro import GyroFit, fit_gyro
    from .sensor import SensorCalibration, Triad
    from .soundness import doubts
    from .sources import load_sources
    from .spacing import SpacingFit, fit_spacing
    from .static import Segment, segments_of, still_spans
    from .walk import (
        ELEMENTS,
        MISALIGNMENT,
        FootResult,
        PivotFit,
        WalkCalibration,
        calibrate_walks,
        fit_pivot,
        median_explained,
        median_of,
        weakest,
    )

__getattr__, __dir__ = lazy_face(__name__)

__all__ = [
    "ANY",
    "ELEMENTS",
    "MISALIGNMENT",
    "MODELS",
    "AccelerometerFit",
    "BiasMemory",
    "Calibration",
    "CalibrationError",
    "CrossValidation",
    "FootResult",
    "GyroFit",
    "PivotFit",
    "RememberedStand",
    "Segment",
    "SensorCalibration",
    "SpacingFit",
    "Triad",
    "WalkCalibration",
    "calibrate_walks",
    "calibrated",
    "cross_validate",
    "doubts",
    "fit_accelerometer",
    "fit_gyro",
    "fit_pivot",
    "fit_spacing",
    "for_feet",
    "load_sources",
    "median_explained",
    "median_of",
    "parameter_text",
    "rms",
    "segments_of",
    "sensor_calibration",
    "stands_in",
    "stands_of",
    "still_spans",
    "weakest",
    "why_not",
]
