"""Checks that the samples of a sensor at rest are measurements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from ..core import STANDARD_GRAVITY, CalibrationError, ImuSeries
from ..inspection import (
    AXES,
    GRAVITY_ERROR,
    STUCK_SHARE,
    Channel,
    Held,
    Quality,
    Stuck,
    held_at_rest,
    quality_of,
)
from ..inspection import TRIADS as WORDS
from ..timing import clean
from .sensor import TRIADS

RATES = (5.0, 10_000.0)  # Hz
UNITS = ("m/s^2", "rad/s")


def usable_samples(series: ImuSeries, name: str) -> ImuSeries:
    """Return the samples with increasing stamps and finite values.

    Raises
    ------
    CalibrationError
        When none can be used, or stamps or values are those of no measurement.
    """
    _check_stamps(series, name)
    quality = quality_of(series)
    if quality.not_finite and quality.usable < 2:
        raise CalibrationError(
            f"'{name}': {not_finite(quality)}, so nothing is left; repair the driver or the "
            "export, and record again"
        )
    good = clean(series).series
    _check_columns(good, name)
    for stuck in quality.stuck:
        if stuck.share > STUCK_SHARE:
            raise CalibrationError(f"'{name}': {_stuck_sentence(stuck, good)}")
    return good


def check_measured(still: ImuSeries, name: str, triad: str) -> None:
    """Raise CalibrationError when an axis of ``triad`` holds its value through a standstill."""
    held = [h for h in held_at_rest(still) if TRIADS[h.triad] == triad]
    if held:
        raise CalibrationError(f"'{name}': {_held_sentence(held)}")


def doubts(
    series: ImuSeries, name: str, triad: str, standstills: list[ImuSeries]
) -> Iterator[str]:
    """Yield the faults of a recording from which ``triad`` can be calibrated all the same."""
    quality = quality_of(series)
    if quality.not_finite:
        yield f"'{name}': {not_finite(quality)} and left out; repair the driver or the export"
    if quality.begins_anew:
        yield f"'{name}': the stamps jump back and go on from there; only what is before is used"
    good = clean(series).series
    for stuck in quality.stuck:
        yield f"'{name}': {_stuck_sentence(stuck, good)}"
    for still in standstills:
        held = [h for h in held_at_rest(still) if TRIADS[h.triad] != triad]
        if held:
            yield f"'{name}': {_held_sentence(held)}; the {triad} is not affected"
            return


def not_finite(quality: Quality) -> str:
    """Return the number of samples that are not finite, in words."""
    return (
        f"{quality.not_finite} of {quality.samples} samples are not finite (nan or inf; the first "
        f"is sample {quality.first_not_finite})"
    )


def _check_stamps(series: ImuSeries, name: str) -> None:
    steps = np.diff(series.stamp_ns)
    if not len(steps):
        return
    forward = steps[steps > 0]
    if not len(forward):
        raise CalibrationError(
            f"'{name}': the stamps of its {len(series)} samples do not increase; check the driver "
            "or the export"
        )
    interval = float(np.median(forward)) * 1e-9
    if not RATES[0] <= 1.0 / interval <= RATES[1]:
        raise CalibrationError(
            f"'{name}': by its stamps it was sampled at {1.0 / interval:.6g} Hz (median interval "
            f"{interval:.3g} s); allowed is {RATES[0]:g} to {RATES[1]:g} Hz, so check the unit of "
            "the stamps (SampleTimeFine of an export is in microseconds)"
        )


def _check_columns(good: ImuSeries, name: str) -> None:
    """Refuse an angular rate that is gravity where the specific force is not."""
    if not len(good):
        return
    force = float(np.median(np.linalg.norm(good.specific_force, axis=1)))
    rate = float(np.median(np.linalg.norm(good.angular_rate, axis=1)))
    if abs(force - STANDARD_GRAVITY) < GRAVITY_ERROR:
        return
    for value, unit in ((rate, "rad/s"), (float(np.degrees(rate)), "deg/s")):
        if abs(value - STANDARD_GRAVITY) < GRAVITY_ERROR:
            raise CalibrationError(
                f"'{name}': the specific force is {force:.3g} m/s^2 and the angular rate "
                f"{value:.3g} {unit} in the median, so accelerometer and gyro seem to be "
                "exchanged; exchange their columns (or what the driver publishes)"
            )


def _stuck_sentence(stuck: Stuck, good: ImuSeries) -> str:
    values = np.concatenate([good.specific_force, good.angular_rate], axis=1)
    at = int(np.argmin(np.abs((good.stamp_ns - good.stamp_ns[0]) * 1e-9 - stuck.first_s)))
    if stuck.what is Channel.SENSOR:
        problem = "the sensor repeats itself"
        value = f"specific force {_text(values[at, :3])} m/s^2, rate {_text(values[at, 3:])} rad/s"
    else:
        problem = f"{stuck.what} is stuck while the others move"
        column = AXES.index(stuck.what)
        value = f"at {values[at, column]:.4g} {UNITS[column // 3]}"
    return (
        f"{problem} ({value}, first {stuck.first_s:.1f} s after the start and for up to "
        f"{stuck.longest_s:.1f} s, {stuck.share:.0%} of the samples); check the "
        "sensor, and its driver or export, which may fill gaps with old values, and record again"
    )


def _held_sentence(axes: Sequence[Held]) -> str:
    """Return the values that the axes of one triad hold, in words."""
    words, unit = WORDS[axes[0].triad], UNITS[axes[0].triad]
    one = len(axes) == 1
    return (
        f"{words} {', '.join(h.axis for h in axes)} stay{'s' if one else ''} at "
        f"{_text([h.value for h in axes])} {unit} in {min(h.share for h in axes):.0%} of the "
        f"standstill, with no noise of {'its' if one else 'their'} own, so the sensor is stuck or "
        "limited there; check the sensor, its range and its export, and record again"
    )


def _text(values: Iterable[float]) -> str:
    return ", ".join(f"{v:.4g}" for v in values)
