"""The samples of one foot in figures: counts, rate, jitter, gaps, standstill, units, clipping."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..core import FloatArray, ImuSeries, IntArray, quantile, row_lengths
from ..recording import evidence_of
from ..timing import AlignerConfig, clean, finite_samples
from .gyro_agreement import GyroAgreement, gyro_agreement
from .overlaid import Overlaid, find_overlaid
from .standstill import Stand, first_stand
from .stuck_values import Stuck, find_stuck

CLIP_RATE = 4.0  # rad/s and m/s^2: below this an extreme that repeats is no clipping
CLIP_FORCE = 15.0
CLIP_LEAST = 3  # samples at an extreme, on end or in different peaks; two may be one peak's top
STEP_IS_LONG = 1.6  # times the usual interval: a sample is missing


class GravityFrom(StrEnum):
    """Where the specific force was taken for gravity; the values are the words for it."""

    STAND = "at rest"
    STANCES = "in its quiet moments"
    ALL = "in the median"
    """Of a foot that is never quiet: 9.8 to 22 m/s^2, by the speed of the walk."""


@dataclass(frozen=True)
class Quality:
    """The samples of one foot in figures.

    Attributes
    ----------
    samples : all of them; ``usable`` are those with increasing stamps and finite values
    not_finite, duplicate, out_of_order : refused samples
    first_not_finite : index of the first one, or None
    begins_anew : the stamps jump back for good somewhere (two recordings in one)
    start_s, end_s : s, first and last usable stamp
    rate_hz : Hz, from the median interval
    jitter_s : s, 95 % of the intervals differ from a multiple of the median by less (intervals
        without gaps; a multiple where samples are missing)
    missing : samples that intervals shorter than a gap leave room for
    gaps, longest_gap_s : intervals longer than ``Sync.max_gap``, and the longest interval
    stand : the first standstill, or None
    gravity, gravity_from : |specific force|, and where it was taken
    high_rate : 98 % quantile of |angular rate|
    peak_force, peak_rate : greatest absolute value of an axis
    clipped_force, clipped_rate : samples at the end of the range
    overlaid : where samples of two times lie between each other, or None
    stuck : axes, or the whole sensor, that repeat their values
    gyro : how the gyro agrees with the accelerometer; None without some steps
    """

    samples: int
    usable: int
    not_finite: int
    duplicate: int
    out_of_order: int
    first_not_finite: int | None
    begins_anew: bool
    start_s: float
    end_s: float
    rate_hz: float
    jitter_s: float
    missing: int
    gaps: int
    longest_gap_s: float
    stand: Stand | None
    gravity: float
    gravity_from: GravityFrom
    high_rate: float
    peak_force: float
    peak_rate: float
    clipped_force: int
    clipped_rate: int
    overlaid: Overlaid | None = None
    stuck: tuple[Stuck, ...] = ()
    gyro: GyroAgreement | None = None

    @property
    def duration_s(self) -> float:
        """Time from the first to the last usable sample, s."""
        return self.end_s - self.start_s


def quality_of(series: ImuSeries, config: AlignerConfig | None = None) -> Quality:
    """Return the facts of ``series``."""
    config = config or AlignerConfig()
    good, counters, restart_at = clean(series, config)
    bad = np.flatnonzero(~finite_samples(series))
    rhythm, stand = _rhythm(good.stamp_ns, config), first_stand(good)
    gravity, gravity_from = _gravity(good, stand)
    some = len(good) > 0
    return Quality(
        samples=len(series),
        usable=len(good),
        not_finite=len(bad),
        duplicate=counters["duplicate"],
        out_of_order=counters["out_of_order"],
        first_not_finite=int(bad[0]) if len(bad) else None,
        begins_anew=restart_at is not None,
        start_s=int(good.stamp_ns[0]) * 1e-9 if some else float("nan"),
        end_s=int(good.stamp_ns[-1]) * 1e-9 if some else float("nan"),
        rate_hz=good.rate_hz,
        jitter_s=rhythm.jitter_s,
        missing=rhythm.missing,
        gaps=counters["gap"],
        longest_gap_s=rhythm.longest_gap_s,
        stand=stand,
        gravity=gravity,
        gravity_from=gravity_from,
        high_rate=_quantile(good.angular_rate, 0.98),
        peak_force=float(np.abs(good.specific_force).max(initial=0.0)),
        peak_rate=float(np.abs(good.angular_rate).max(initial=0.0)),
        clipped_force=clipped(good.specific_force, CLIP_FORCE),
        clipped_rate=clipped(good.angular_rate, CLIP_RATE),
        overlaid=find_overlaid(good),
        stuck=find_stuck(good),
        gyro=gyro_agreement(good),
    )


def _gravity(series: ImuSeries, stand: Stand | None) -> tuple[float, GravityFrom]:
    if stand is not None:
        return stand.gravity, GravityFrom.STAND
    evidence = evidence_of(series)
    return evidence.gravity, GravityFrom.STANCES if evidence.quiet else GravityFrom.ALL


class _Rhythm(NamedTuple):
    """What the intervals of the samples tell, as in :class:`Quality`."""

    jitter_s: float
    missing: int
    longest_gap_s: float


def _rhythm(stamp_ns: IntArray, config: AlignerConfig) -> _Rhythm:
    steps = np.diff(stamp_ns)
    regular = steps[steps <= config.max_gap_ns]
    off = _off_beat(regular) if len(regular) else np.zeros(1)
    return _Rhythm(
        quantile(off, 0.95) * 1e-9,
        _missing(regular),
        float(steps.max()) * 1e-9 if len(steps) else 0.0,
    )


def clipped(values: FloatArray, least: float) -> int:
    """Count the samples (N, 3) at the end of the range: an extreme that is reached repeatedly.

    A range that is not reached has an extreme that occurs once, or twice at the top of one peak;
    one that is reached holds it for samples on end, or in peak after peak.  ``least`` is the
    smallest value that can be the end of a range.
    """
    count = 0
    for column in values.T:
        for side in (column, -column):
            top = side == side.max(initial=-np.inf)
            held = top[1:] & top[:-1]
            if top.sum() >= CLIP_LEAST and held.any() and side.max() > least:
                count += int(top.sum())
    return count


def _off_beat(steps: IntArray) -> FloatArray:
    """Return the distance (N,) ns of intervals from the nearest multiple of their median."""
    usual = float(np.median(steps))
    count = np.maximum(1.0, np.rint(steps / usual)) if usual > 0 else 1.0
    off: FloatArray = np.abs(steps - count * usual)
    return off


def _missing(steps: IntArray) -> int:
    """Return how many samples the intervals (N,) ns leave room for."""
    if not len(steps):
        return 0
    usual = float(np.median(steps))
    long = steps[steps > STEP_IS_LONG * usual]
    return int(np.rint(long / usual).sum()) - len(long) if usual > 0 else 0


def _quantile(vectors: FloatArray, share: float) -> float:
    if not len(vectors):
        return float("nan")
    return quantile(row_lengths(vectors), share)
