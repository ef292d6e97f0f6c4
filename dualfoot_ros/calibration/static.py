"""Standstills of a sensor in different attitudes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core import (
    STANDARD_GRAVITY,
    CalibrationError,
    FloatArray,
    ImuSeries,
    Parameters,
    parameter,
)
from ..inspection import GRAVITY_ERROR, quality_of
from ..timing import clean
from .soundness import check_measured, not_finite, usable_samples

NEAR = np.cos(np.radians(15.0))  # attitudes closer than this are one


@dataclass(frozen=True)
class StandstillConfig(Parameters):
    """Limits within which a sensor counts as still."""

    window: float = parameter(
        0.5, "length of the windows that are checked", unit="s", minimum=0.1, maximum=5.0
    )
    duration: float = parameter(
        2.0, "a shorter standstill is not used", unit="s", minimum=0.5, maximum=600.0
    )
    max_force_std: float = parameter(
        0.05, "specific force scatter of a still window", unit="m/s^2", minimum=1e-4, maximum=5.0
    )
    max_rate_std: float = parameter(
        0.02, "angular rate scatter of a still window", unit="rad/s", minimum=1e-5, maximum=1.0
    )
    max_drift: float = parameter(
        0.05,
        "specific force may change within a standstill by",
        unit="m/s^2",
        minimum=1e-4,
        maximum=5.0,
    )


@dataclass(frozen=True)
class Segment:
    """One standstill.

    Attributes
    ----------
    name : of the recording, and which standstill in it
    duration_s : its length
    samples : specific force (N, 3) m/s^2
    rate : (3,) rad/s, mean angular rate
    """

    name: str
    duration_s: float
    samples: FloatArray
    rate: FloatArray

    @property
    def mean(self) -> FloatArray:
        """Return the mean specific force (3,) m/s^2."""
        force: FloatArray = self.samples.mean(axis=0)
        return force

    @property
    def direction(self) -> FloatArray:
        """Return the unit vector (3,) that points up, in the axes of the sensor."""
        mean = self.mean
        return mean / float(np.linalg.norm(mean))

    def half(self, which: int) -> Segment:
        """Return the first (0) or the second (1) half of the standstill."""
        middle = len(self.samples) // 2
        part = self.samples[:middle] if which == 0 else self.samples[middle:]
        return Segment(self.name, self.duration_s / 2.0, part, self.rate)


def segments_of(
    series: ImuSeries, name: str, config: StandstillConfig | None = None
) -> list[Segment]:
    """Return the standstills of a recording.

    Raises
    ------
    CalibrationError
        When there is none, its gravity shows that the unit is wrong, or its values are no
        measurements.
    """
    config = config or StandstillConfig()
    good = usable_samples(series, name)
    spans = still_spans(good, config)
    if not spans:
        raise CalibrationError(no_standstill(series, name, config))
    segments = []
    for number, span in enumerate(spans, start=1):
        part = good[span]
        label = name if len(spans) == 1 else f"{name} ({number})"
        check_measured(part, label, "accelerometer")
        rate = part.angular_rate.mean(axis=0)
        segments.append(Segment(label, part.duration_s, part.specific_force, rate))
        check_gravity(segments[-1])
    return segments


def check_gravity(segment: Segment) -> None:
    """Raise CalibrationError when the specific force at rest is not gravity in m/s^2."""
    norm = float(np.linalg.norm(segment.mean))
    if abs(norm - STANDARD_GRAVITY) > GRAVITY_ERROR:
        raise CalibrationError(
            f"'{segment.name}': the specific force at rest is {norm:.4g} m/s^2; allowed is "
            f"9.8 +- {GRAVITY_ERROR:g}, so check the unit, and that gravity was not taken out"
        )


def attitudes(segments: Sequence[Segment]) -> list[int]:
    """Return for each segment the number of its attitude; those within 15 degrees are one."""
    firsts: list[FloatArray] = []
    numbers = []
    for segment in segments:
        near = [i for i, up in enumerate(firsts) if float(up @ segment.direction) > NEAR]
        if not near:
            firsts.append(segment.direction)
        numbers.append(near[0] if near else len(firsts) - 1)
    return numbers


def still_spans(good: ImuSeries, config: StandstillConfig | None = None) -> list[slice]:
    """Return the samples of each standstill; a change of attitude or a gap ends one."""
    config = config or StandstillConfig()
    size = _size(good, config)
    if not size:
        return []
    needed = max(1, round(config.duration * good.rate_hz / size))
    windows = _windows(good, size)
    return [
        slice(first * size, last * size)
        for first, last in _runs(windows.force.mean(axis=1), windows.still(config), config)
        if last - first >= needed
    ]


def no_standstill(series: ImuSeries, name: str, config: StandstillConfig) -> str:
    """Return a sentence on a recording without standstill: how still it is at best."""
    good, quality = clean(series).series, quality_of(series)
    problem = f"'{name}': no standstill of {config.duration:g} s in {good.duration_s:.1f} s"
    if quality.not_finite:
        return f"{problem}, for {not_finite(quality)}; repair the driver or the export"
    advice = "hold the sensor still, best on a table"
    size = _size(good, config)
    if not size:
        return f"{problem}; {advice}"
    windows = _windows(good, size)
    if not windows.whole.any():
        return (
            f"{problem} without {quality.gaps} gaps; check the link of the sensor and the export"
        )
    force = float(windows.force[windows.whole].std(axis=1).max(axis=1).min())
    rate = float(windows.rate[windows.whole].std(axis=1).max(axis=1).min())
    return (
        f"{problem} (in the stillest {config.window:g} s the specific force scatters by "
        f"{force:.3g} m/s^2, allowed is {config.max_force_std:g}, and the angular rate by "
        f"{rate:.3g} rad/s, allowed is {config.max_rate_std:g}); {advice}"
    )


class _Windows(NamedTuple):
    """Specific force and angular rate by windows (W, size, 3), and which are without a gap."""

    force: FloatArray
    rate: FloatArray
    whole: np.ndarray

    def still(self, config: StandstillConfig) -> np.ndarray:
        """Return (W,) bool."""
        force_std = self.force.std(axis=1).max(axis=1)
        rate_std = self.rate.std(axis=1).max(axis=1)
        still: np.ndarray = (
            self.whole & (force_std < config.max_force_std) & (rate_std < config.max_rate_std)
        )
        return still


def _size(good: ImuSeries, config: StandstillConfig) -> int:
    """Return the samples of a window; 0 when there are not enough for one."""
    size = max(5, round(config.window * good.rate_hz)) if len(good) > 1 else 0
    return size if len(good) >= size else 0


def _windows(good: ImuSeries, size: int) -> _Windows:
    count = len(good) // size
    stamps = good.stamp_ns[: count * size]
    intervals = np.diff(stamps, prepend=stamps[:1] - round(1e9 / good.rate_hz))
    whole = np.logical_and.reduce((intervals < 1.6e9 / good.rate_hz).reshape(count, size), axis=1)
    force = good.specific_force[: count * size].reshape(count, size, 3)
    return _Windows(force, good.angular_rate[: count * size].reshape(count, size, 3), whole)


def _runs(
    means: FloatArray, still: np.ndarray, config: StandstillConfig
) -> Iterator[tuple[int, int]]:
    """Yield the runs of still windows, ended where the sensor has come into another attitude."""
    first: int | None = None
    for k in range(len(still)):
        if first is not None:
            moved = np.abs(means[k] - means[first]).max() > config.max_drift
            if moved or not still[k]:
                yield first, k
                first = None
        if first is None and still[k]:
            first = k
    if first is not None:
        yield first, len(still)
