"""Calibrations on disk: one small YAML for one sensor, or for both feet.

::

    format: dualfoot_calibration
    version: 1
    calibration:
      right:                       # left, right, or sensor (no foot was named)
        accelerometer:
          bias: [-0.0172, 0.0347, -0.0153]          # m/s^2
          matrix: [[0.99749, 0.0, 0.0], [0.0, 0.99899, 0.0], [0.0, 0.0, 0.99699]]
          about: {...}             # details of the fit; not used
        gyro:
          bias: [-0.0431, -0.0257, -0.0402]         # rad/s; matrix is the identity if left out

The axes are those of the samples it was made from; corrected = matrix (measured - bias).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core import FEET, CalibrationError, FloatArray
from ..recording import write_text
from .sensor import TRIADS, SensorCalibration, Triad

FORMAT = "dualfoot_calibration"
VERSION = 1
ANY = "sensor"
NAMES = (*FEET, ANY)
LARGEST_BIAS = {"accelerometer": 5.0, "gyro": 0.5}
UNIT = {"accelerometer": "m/s^2", "gyro": "rad/s"}
SCALE = (0.5, 2.0)
LARGEST_MISALIGNMENT = 0.5


@dataclass(frozen=True)
class Calibration:
    """The calibrations of a file by name: "left", "right", or "sensor" when no foot was named."""

    sensors: Mapping[str, SensorCalibration] = field(default_factory=dict)

    def of(self, foot: str) -> SensorCalibration | None:
        """Return the calibration of the sensor on ``foot``, None when the file has none.

        A calibration that names no foot is for the sensor it is given to.
        """
        return self.sensors.get(foot, self.sensors.get(ANY))

    def with_triad(self, name: str, triad: str, calibrated: Triad) -> Calibration:
        """Return this with one triad of one sensor put in or replaced."""
        sensor = replace(self.sensors.get(name, SensorCalibration()), **{triad: calibrated})
        return Calibration({**self.sensors, name: sensor})

    def save(self, path: str | Path) -> None:
        """Write to ``path``, whole or not at all; raise OSError when it cannot."""
        import yaml

        sensors = {
            name: {triad: _triad_document(values) for triad, values in sensor.triads().items()}
            for name, sensor in sorted(self.sensors.items())
        }
        document = {"format": FORMAT, "version": VERSION, "calibration": sensors}
        text = yaml.safe_dump(document, sort_keys=False, default_flow_style=None, width=98)
        write_text(Path(path), text)

    @classmethod
    def load(cls, path: str | Path) -> Calibration:
        """Read a calibration file.

        Raises
        ------
        CalibrationError
            When it is no calibration file; names the key, its value and what is allowed.
        OSError
            When the file cannot be read.
        """
        import yaml

        try:
            document = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
            return cls(_sensors(document))
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            reason = " ".join(str(error).split())
            raise CalibrationError(f"calibration '{path}' is no YAML: {reason}") from None
        except CalibrationError as error:
            raise CalibrationError(f"calibration '{path}': {error}") from None


def _triad_document(triad: Triad) -> dict[str, Any]:
    document: dict[str, Any] = {
        "bias": [round(float(v), 9) for v in triad.bias],
        "matrix": [[round(float(v), 9) for v in row] for row in triad.matrix],
    }
    return {**document, "about": dict(triad.about)} if triad.about else document


def _sensors(document: Any) -> dict[str, SensorCalibration]:
    _mapping("it", document, ("format", "version", "calibration"))
    _require("format", document.get("format"), document.get("format") == FORMAT, FORMAT)
    _require("version", document.get("version"), document.get("version") == VERSION, str(VERSION))
    sensors = document.get("calibration")
    _mapping("calibration", sensors, NAMES)
    _require("calibration", sensors, len(sensors) > 0, f"at least one of {', '.join(NAMES)}")
    return {name: _sensor(f"calibration.{name}", section) for name, section in sensors.items()}


def _sensor(where: str, section: Any) -> SensorCalibration:
    _mapping(where, section, TRIADS)
    return SensorCalibration(
        **{triad: _triad(f"{where}.{triad}", triad, values) for triad, values in section.items()}
    )


def _triad(where: str, kind: str, section: Any) -> Triad:
    _mapping(where, section, ("bias", "matrix", "about"))
    limit, unit = LARGEST_BIAS[kind], UNIT[kind]
    bias = _numbers(section.get("bias"), (3,))
    good = bias is not None and bool(np.all(np.abs(bias) <= limit))
    allowed = f"three numbers in [{-limit:g}, {limit:g}] {unit}"
    _require(f"{where}.bias", section.get("bias"), good, allowed)
    given = section.get("matrix", np.eye(3).tolist())
    matrix = _numbers(given, (3, 3))
    _require(
        f"{where}.matrix",
        given,
        matrix is not None and _plausible(matrix),
        f"three rows of three numbers, on the diagonal in [{SCALE[0]:g}, {SCALE[1]:g}], beside "
        f"it in [{-LARGEST_MISALIGNMENT:g}, {LARGEST_MISALIGNMENT:g}]",
    )
    about = section.get("about", {})
    _require(f"{where}.about", about, isinstance(about, dict), "a mapping")
    assert bias is not None and matrix is not None
    return Triad(bias, matrix, about)


def _plausible(matrix: FloatArray) -> bool:
    scale = np.diag(matrix)
    beside = matrix - np.diag(scale)
    in_range = bool(np.all((scale >= SCALE[0]) & (scale <= SCALE[1])))
    return in_range and bool(np.all(np.abs(beside) <= LARGEST_MISALIGNMENT))


def _numbers(value: Any, shape: tuple[int, ...]) -> FloatArray | None:
    """Return ``value`` as an array of finite numbers of that shape, or None."""
    flat = value
    for _ in shape[1:]:
        if not isinstance(flat, list) or not all(isinstance(row, list) for row in flat):
            return None
        flat = [item for row in flat for item in row]
    if not isinstance(flat, list) or not all(_is_number(item) for item in flat):
        return None
    try:
        array = np.array(value, dtype=np.float64)
    except ValueError:
        return None
    return array if array.shape == shape else None


def _is_number(item: Any) -> bool:
    return isinstance(item, (int, float)) and not isinstance(item, bool) and math.isfinite(item)


def _mapping(where: str, value: Any, known: tuple[str, ...]) -> None:
    _require(where, value, isinstance(value, dict), f"a mapping with {', '.join(known)}")
    for key in value:
        if key not in known:
            raise CalibrationError(f"unknown key '{key}' in {where}; known: {', '.join(known)}")


def _require(where: str, value: Any, good: bool, allowed: str) -> None:
    if not good:
        raise CalibrationError(f"{where} is {value!r}; allowed is {allowed}")
