"""The calibration of both sensors from ordinary walks, with everything that checks it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core import FEET, CalibrationError, DualFootError, FloatArray, TrackerConfig
from ...evaluation import pair_samples, track_samples
from ...inspection import unconstrained_config
from ...recording import Recording
from ..sensor import SensorCalibration, Triad
from .filter_terms import FilterNoise, symmetric
from .foot_walk import FootWalk, foot_walk
from .gyro_matrix import GyroMatrixFit, fit_matrix
from .known_points import BeforeAndAfter, walk_errors
from .left_out import LeftOut, leave_each_out
from .observability import Turns, advice, turns
from .self_test import SelfTest, self_test

MISALIGNMENT = 0.003  # rad, of an accelerometer whose misalignment is not calibrated
SYSTEMATIC = 0.0015  # of an element, by what the model leaves out; seen on simulated sensors
NamedRecording = tuple[str, Recording]
Progress = Callable[[float], None]


@dataclass(frozen=True)
class FootResult:
    """The calibration of one sensor.

    Attributes
    ----------
    fit : matrix and its covariance
    bias : (3,) rad/s that was taken off the samples first, zero without a gyro calibration
    misalignment : rad, that the accelerometer may have; it goes into xy, xz and yz
    scaled : whether bias and scale factors of the accelerometer were calibrated
    left_out : check of each walk with the matrix of the others
    test : the self-test
    turned : turns of the walks
    """

    fit: GyroMatrixFit
    bias: FloatArray
    misalignment: float
    scaled: bool
    left_out: tuple[LeftOut, ...]
    test: SelfTest
    turned: Turns

    @property
    def elements_std(self) -> FloatArray:
        """Standard deviations (6,) of the elements, those of axes and model included."""
        of_axes = np.hypot(SYSTEMATIC, [0.0] * 3 + [self.misalignment] * 3)
        stds: FloatArray = np.hypot(self.fit.elements_std, of_axes)
        return stds

    def triad(self) -> Triad:
        """Return the entry of the calibration file."""
        about = {
            "model": "walk",
            "walks": len(self.fit.walks),
            "std": [round(float(v), 6) for v in self.elements_std],
            "elements": "xx, yy, zz, xy, xz, yz",
            "accelerometer_misalignment": self.misalignment,
        }
        return Triad(self.bias, self.fit.matrix, about)

    def remarks(self) -> Iterator[str]:
        """Yield sentences on what limits the matrix."""
        yield from advice(self.fit, self.turned)
        if not self.scaled:
            yield (
                "the accelerometer is not calibrated; calibrate it first ('dualfoot calibrate "
                "accelerometer'), as its errors go into the matrix"
            )
        elif self.misalignment > 0.0:
            yield (
                "the axes of the accelerometer are not known to be at right angles: "
                f"{1e3 * self.misalignment:g} mrad are in the uncertainty of xy, xz and yz; nine "
                "attitudes or more calibrate that"
            )
        if not self.test.passed:
            yield (
                f"the self-test is off by {100 * self.test.error:.2f} % of an element; do not use "
                "this matrix"
            )


@dataclass(frozen=True)
class WalkCalibration:
    """Both sensors from a set of walks; ``checks`` are by name of the walk, where it has loops."""

    names: tuple[str, ...]
    feet: Mapping[str, FootResult]
    checks: Mapping[str, BeforeAndAfter]

    def sensors(self, given: Mapping[str, SensorCalibration]) -> dict[str, SensorCalibration]:
        """Return the calibrations ``given`` with the gyro of each foot put in or replaced."""
        return {
            foot: replace(given.get(foot, SensorCalibration()), gyro=result.triad())
            for foot, result in self.feet.items()
        }


def calibrate_walks(
    recordings: Sequence[NamedRecording],
    config: TrackerConfig | None = None,
    given: Mapping[str, SensorCalibration] | None = None,
    *,
    noise: FilterNoise | None = None,
    misalignment: float = MISALIGNMENT,
    progress: Progress | None = None,
) -> WalkCalibration:
    """Fit the gyro matrices of both sensors to walks, and check them.

    Parameters
    ----------
    recordings : walks by name, all with the same two sensors on the same feet
    config : of the tracker that the checks run; stances and pivot of it count for the fit
    given : foot -> calibration so far; its accelerometer and gyro bias are applied, its gyro
        matrix is replaced
    noise : of the fit
    misalignment : rad, of an accelerometer whose misalignment is not calibrated
    progress : is told the share that is done, 0-1

    Raises
    ------
    CalibrationError
        When a walk has too few steps; names it.
    DualFootError
        What pairing and tracker refuse.
    """
    given, config = given or {}, config or TrackerConfig()
    done = _Done(progress, 2 * len(recordings) + len(FEET))
    first = {foot: _without_matrix(given.get(foot)) for foot in FEET}
    walks: dict[str, list[FootWalk]] = {foot: [] for foot in FEET}
    for name, recording in recordings:
        for foot, walk in _feet(name, recording.corrected(first), config).items():
            walks[foot].append(walk)
        done.step()
    results = {}
    for foot in FEET:
        fit = fit_matrix(walks[foot], (config.zupt.lever_arm, config.zupt.lever_back), noise)
        results[foot] = _result(walks[foot], fit, first[foot], misalignment)
        done.step()
    checks = {}
    for k, (name, recording) in enumerate(recordings):
        found = _check(recording, config, first, {f: r.left_out for f, r in results.items()}, k)
        if found is not None:
            checks[name] = found
        done.step()
    return WalkCalibration(tuple(name for name, _ in recordings), results, checks)


class _Done:
    """Tells the share that is done, step by step."""

    def __init__(self, progress: Progress | None, steps: int) -> None:
        self._progress, self._steps, self._count = progress, steps, 0

    def step(self) -> None:
        self._count += 1
        if self._progress is not None:
            self._progress(self._count / self._steps)


def _without_matrix(sensor: SensorCalibration | None) -> SensorCalibration:
    """Return a calibration without the gyro matrix, which is to be fitted."""
    sensor = sensor or SensorCalibration()
    bias = np.zeros(3) if sensor.gyro is None else sensor.gyro.bias
    return replace(sensor, gyro=Triad(bias, np.eye(3)))


def _feet(name: str, recording: Recording, config: TrackerConfig) -> dict[str, FootWalk]:
    alone = unconstrained_config(config)
    try:
        samples = pair_samples(recording)
        tracked = track_samples(samples, alone)
        return {foot: foot_walk(getattr(samples, foot), tracked, foot, alone) for foot in FEET}
    except DualFootError as error:
        raise CalibrationError(f"'{name}': {error}") from None


def _result(
    walks: Sequence[FootWalk], fit: GyroMatrixFit, sensor: SensorCalibration, misalignment: float
) -> FootResult:
    accelerometer = sensor.accelerometer
    known = accelerometer is not None and accelerometer.about.get("model") == "full"
    assert sensor.gyro is not None
    return FootResult(
        fit=fit,
        bias=sensor.gyro.bias,
        misalignment=0.0 if known else misalignment,
        scaled=accelerometer is not None,
        left_out=leave_each_out(fit),
        test=self_test(walks, fit),
        turned=turns(walks),
    )


def _check(
    recording: Recording,
    config: TrackerConfig,
    first: Mapping[str, SensorCalibration],
    left_out: Mapping[str, Sequence[LeftOut]],
    k: int,
) -> BeforeAndAfter | None:
    """Return the errors of walk ``k`` before and after, None where nothing shows them."""
    reference = recording.reference
    if reference is None or not (reference.closed_loop or reference.markers):
        return None
    if not all(left_out.values()):
        return None
    after = {
        foot: with_matrix(first[foot], np.eye(3) + symmetric(checks[k].elements))
        for foot, checks in left_out.items()
    }
    before = walk_errors(recording, config, first)
    return BeforeAndAfter(before, walk_errors(recording, config, after))


def with_matrix(sensor: SensorCalibration, matrix: FloatArray) -> SensorCalibration:
    """Return a calibration with this gyro matrix (3, 3)."""
    bias = np.zeros(3) if sensor.gyro is None else sensor.gyro.bias
    return replace(sensor, gyro=Triad(bias, matrix))


def median_of(values: Sequence[float | None]) -> float | None:
    """Return the median of the values that are there."""
    there = [value for value in values if value is not None and math.isfinite(value)]
    return float(np.median(there)) if there else None
