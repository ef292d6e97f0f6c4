"""Calibration of sensors and gait from recordings made for it, and its files."""

from .errors import CalibrationError
from .feet import calibrated, for_feet, sensor_calibration
from .file import Calibration
from .sensor import SensorCalibration, Triad

__all__ = [
    "Calibration",
    "CalibrationError",
    "SensorCalibration",
    "Triad",
    "calibrated",
    "for_feet",
    "sensor_calibration",
]
