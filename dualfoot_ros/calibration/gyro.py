"""Bias of a gyro from a standstill, and the noise of both triads from a long one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core import CalibrationError, FloatArray, ImuSeries
from .allan import FLOOR, AllanCurve, Slopes, allan_curve, slopes_of
from .sensor import TRIADS, Triad
from .soundness import check_measured, usable_samples
from .static import StandstillConfig, no_standstill, still_spans

LARGEST_BIAS = 0.15  # rad/s; more is a rotation (alignment.max_rate)
UNITS = {"gyro": "rad/s", "accelerometer": "m/s^2"}


@dataclass(frozen=True)
class GyroFit:
    """Bias of the gyro, and the noise of gyro and accelerometer.

    Attributes
    ----------
    bias, bias_std : (3,) rad/s, and the standard deviation of the mean of this standstill
    standstill : the samples it comes from
    curves : triad -> Allan deviation of its axes
    slopes : triad -> noise parameters from the curve of each axis
    """

    bias: FloatArray
    bias_std: FloatArray
    standstill: ImuSeries
    curves: Mapping[str, AllanCurve]
    slopes: Mapping[str, tuple[Slopes, ...]]

    def triad(self) -> Triad:
        """Return the entry of the calibration file."""
        about = {
            "bias_std": [round(float(v), 9) for v in self.bias_std],
            "standstill": round(self.standstill.duration_s, 3),
        }
        return Triad(self.bias, np.eye(3), about)

    def noise(self, bias_time_s: float) -> dict[str, float]:
        """Return the noise parameters that every axis shows, with the values of the worst axis.

        ``noise.*_bias`` drives a first-order Gauss-Markov bias of correlation time
        ``bias_time_s``: with the random walk K where the curve shows one, otherwise with the
        noise that holds the deviation of that bias at the instability B,
        q = B sqrt(2 / bias_time).
        """
        parameters = {}
        for triad, axes in self.slopes.items():
            named = {
                f"noise.{triad}": [s.white for s in axes],
                f"noise.{triad}_bias": [driving_noise(s, bias_time_s) for s in axes],
            }
            for name, values in named.items():
                shown = [v for v in values if v is not None]
                if len(shown) == len(axes):
                    parameters[name] = max(shown)
        return parameters

    def unseen(self) -> Iterator[str]:
        """Yield a sentence for each noise that the standstill is too short to show."""
        for triad, axes in self.slopes.items():
            curve = self.curves[triad]
            end = f"up to {curve.tau[-1]:.1f} s, a ninth of the {curve.duration_s:.0f} s"
            if any(s.white is None for s in axes):
                yield (
                    f"{triad}: no white noise (slope -1/2) is seen on every axis {end}; use a "
                    "longer standstill, and switch smoothing filters of the sensor off"
                )
            if any(s.floor is None for s in axes):
                least = max(s.lowest for s in axes)
                yield (
                    f"{triad}: no floor is seen on every axis {end}, too short for "
                    f"the bias instability (it is below {least / FLOOR:.3g} {UNITS[triad]}) and "
                    "the driving noise of the bias; record some hours"
                )


def driving_noise(slopes: Slopes, bias_time_s: float) -> float | None:
    """Return the driving noise of the bias of one axis, None where the curve does not show it."""
    if slopes.walk is not None:
        return slopes.walk
    return None if slopes.floor is None else slopes.floor * math.sqrt(2.0 / bias_time_s)


def fit_gyro(
    recordings: Sequence[tuple[str, ImuSeries]], config: StandstillConfig | None = None
) -> GyroFit:
    """Fit on the longest standstill of the named recordings.

    Raises
    ------
    CalibrationError
        When none has a standstill, the sensor turned steadily in it, or its values are no
        measurements.
    """
    config = config or StandstillConfig()
    name, still = _longest(recordings, config)
    bias = still.angular_rate.mean(axis=0)
    worst = int(np.argmax(np.abs(bias)))
    if abs(bias[worst]) > LARGEST_BIAS:
        raise CalibrationError(
            f"'{name}': the mean angular rate of {'xyz'[worst]} is {bias[worst]:.3g} rad/s; "
            f"allowed is {LARGEST_BIAS:g}, so the sensor turned, or the unit is deg/s"
        )
    interval = still.duration_s / (len(still) - 1)
    values = {"accelerometer": still.specific_force, "gyro": still.angular_rate}
    curves = {triad: allan_curve(values[triad], interval) for triad in reversed(TRIADS)}
    slopes = {t: tuple(slopes_of(curve, axis) for axis in range(3)) for t, curve in curves.items()}
    return GyroFit(bias, _bias_std(curves["gyro"], slopes["gyro"]), still, curves, slopes)


def _longest(
    recordings: Sequence[tuple[str, ImuSeries]], config: StandstillConfig
) -> tuple[str, ImuSeries]:
    standstills = []
    for name, series in recordings:
        good = usable_samples(series, name)
        spans = still_spans(good, config)
        for span in spans:
            check_measured(good[span], name, "gyro")
        standstills += [(name, good[span]) for span in spans]
    if not standstills:
        name, series = recordings[0]
        raise CalibrationError(no_standstill(series, name, config))
    return max(standstills, key=lambda named: named[1].duration_s)


def _bias_std(curve: AllanCurve, slopes: Sequence[Slopes]) -> FloatArray:
    """Return the standard deviation (3,) rad/s of the mean over the whole standstill.

    White noise averages out; noise at the bias instability does not.
    """
    white = curve.deviation[-1] * math.sqrt(curve.tau[-1] / curve.duration_s)
    floor = [0.0 if s.floor is None else s.lowest for s in slopes]
    lowest: FloatArray = np.maximum(white, floor)
    return lowest
