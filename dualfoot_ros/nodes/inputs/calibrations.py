"""Calibrations from the file that the parameter ``calibration`` of a node names."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ...calibration import (
    ANY,
    Calibration,
    CalibrationError,
    SensorCalibration,
    for_feet,
    sensor_calibration,
)
from ...core import FEET

FOOT_UNKNOWN = (
    "nothing says which foot this sensor is on: set foot to left or right, or run it in the "
    "namespace left or right"
)


def find_foot(parameter: str, namespace: str) -> str | None:
    """Return the foot that the parameter or the namespace names; None when neither does."""
    if parameter != "auto":
        return parameter
    named = [foot for foot in FEET if foot in namespace.split("/")]
    return named[0] if named else None


def load_for_feet(path: str) -> dict[str, SensorCalibration]:
    """Return the calibrations of the feet in a file; empty where no file is named.

    Raises
    ------
    CalibrationError
        When the file cannot be read or used; names the parameter.
    """
    with _name_parameter(path):
        return for_feet([path] if path else [])


def load_for_sensor(path: str, foot: str | None) -> SensorCalibration | None:
    """Return the calibration of one sensor; None where no file is named.

    Raises
    ------
    CalibrationError
        When the file cannot be read or used, or is for feet and ``foot`` is not known.
    """
    if not path:
        return None
    with _name_parameter(path):
        sensors = Calibration.load(path).sensors
        if foot is None and set(sensors) != {ANY}:
            raise CalibrationError(f"'{path}' is for {' and '.join(sensors)}, and {FOOT_UNKNOWN}")
        return sensor_calibration(path, foot or ANY)


@contextmanager
def _name_parameter(path: str) -> Iterator[None]:
    """Put the name of the parameter before the error of its file."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise CalibrationError(f"parameter 'calibration' is '{path}': {reason}") from None
    except CalibrationError as error:
        raise CalibrationError(f"parameter 'calibration': {error}") from None
