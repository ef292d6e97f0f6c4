"""Calibrations of both feet from the files that a command line or a node names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..core import FEET, CalibrationError
from ..recording import Recording
from .file import ANY, Calibration
from .sensor import SensorCalibration


def for_feet(given: Sequence[str]) -> dict[str, SensorCalibration]:
    """Return the calibration of each foot from ``FILE`` or ``left=FILE``, ``right=FILE``.

    Raises
    ------
    CalibrationError
        When a file cannot be used, names no foot and is given none, or a foot is named twice.
    OSError
        When a file cannot be read.
    """
    calibrations: dict[str, SensorCalibration] = {}
    for text in given:
        for foot, sensor in _load_one(text).items():
            if foot in calibrations:
                raise CalibrationError(f"two calibrations are given for the {foot} foot")
            calibrations[foot] = sensor
    return calibrations


def calibrated(recording: Recording, feet: Mapping[str, SensorCalibration]) -> Recording:
    """Return the recording with the samples of each foot corrected."""
    return recording.corrected(feet)


def sensor_calibration(path: str, foot: str) -> SensorCalibration:
    """Return the calibration of one foot's sensor from a file, for a node.

    Raises
    ------
    CalibrationError
        When the file cannot be used or has nothing on that foot.
    OSError
        When the file cannot be read.
    """
    calibration = Calibration.load(path)
    sensor = calibration.of(foot)
    if sensor is None:
        named = ", ".join(calibration.sensors)
        raise CalibrationError(f"calibration '{path}' is for {named}; it has none for {foot}")
    return sensor


def _load_one(text: str) -> dict[str, SensorCalibration]:
    name, equals, path = text.partition("=")
    if equals and name in FEET:
        return {name: sensor_calibration(path, name)}
    calibration = Calibration.load(text)
    if ANY in calibration.sensors:
        raise CalibrationError(
            f"calibration '{text}' names no foot; say on which the sensor was, as in left={text}"
        )
    return dict(calibration.sensors)
