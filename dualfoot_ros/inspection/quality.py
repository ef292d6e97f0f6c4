"""The samples of one foot in figures: counts, rate, jitter, gaps, standstill, units, clipping."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import DEGREE, FloatArray, ImuSeries, IntArray
from ..recording import UnitEvidence, evidence_of
from ..timing import AlignerConfig, clean
from .standstill import Stand, first_stand
from .stuck_values import Stuck, find_stuck

CLIP_RATE = 4.0  # rad/s and m/s^2: below this an extreme that repeats is no clipping
CLIP_FORCE = 15.0


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
    jitter_s : s, 95 % of the intervals differ from the median by less (intervals without gaps)
    gaps, longest_gap_s : intervals longer than ``Sync.max_gap``, and the longest interval
    stand : the first standstill, or None
    median_force, high_rate : median of |specific force|; 98 % quantile of |angular rate|
    peak_force, peak_rate : greatest absolute value of an axis
    clipped_force, clipped_rate : samples at the end of the range
    stuck : axes, or the whole sensor, that repeat their values
    off_grid_s : s, 95 % of the intervals differ from a multiple of the median by less; lost
        samples leave multiples, times of arrival do not
    too_small : how many times too small the rates are for a foot that walks, 1 where they fit
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
    gaps: int
    longest_gap_s: float
    stand: Stand | None
    median_force: float
    high_rate: float
    peak_force: float
    peak_rate: float
    clipped_force: int
    clipped_rate: int
    stuck: tuple[Stuck, ...] = ()
    off_grid_s: float = 0.0
    too_small: float = 1.0

    @property
    def duration_s(self) -> float:
        """Time from the first to the last usable sample, s."""
        return self.end_s - self.start_s


def quality_of(series: ImuSeries, config: AlignerConfig | None = None) -> Quality:
    """Return the facts of ``series``."""
    config = config or AlignerConfig()
    good, counters, restart_at = clean(series, config)
    finite = np.isfinite(series.specific_force) & np.isfinite(series.angular_rate)
    bad = np.flatnonzero(~finite.all(axis=1))
    steps = np.diff(good.stamp_ns)
    regular = steps[steps <= config.max_gap_ns]
    off = np.abs(regular - np.median(regular)) if len(regular) else np.zeros(1)
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
        jitter_s=float(np.quantile(off, 0.95)) * 1e-9,
        gaps=counters["gap"],
        longest_gap_s=float(steps.max()) * 1e-9 if len(steps) else 0.0,
        stand=first_stand(good),
        median_force=_quantile(good.specific_force, 0.5),
        high_rate=_quantile(good.angular_rate, 0.98),
        peak_force=float(np.abs(good.specific_force).max(initial=0.0)),
        peak_rate=float(np.abs(good.angular_rate).max(initial=0.0)),
        clipped_force=clipped(good.specific_force, CLIP_FORCE),
        clipped_rate=clipped(good.angular_rate, CLIP_RATE),
        stuck=find_stuck(good),
        off_grid_s=_off_grid(regular) * 1e-9,
        too_small=_times_too_small(evidence_of(good)),
    )


def _off_grid(steps: IntArray) -> float:
    """Return by how much 95 % of the intervals (N,) miss multiples of the median at most, ns."""
    median = float(np.median(steps)) if len(steps) else 0.0
    if median <= 0.0:
        return 0.0
    multiples = np.maximum(1.0, np.rint(steps / median))
    return float(np.quantile(np.abs(steps - multiples * median), 0.95))


def _times_too_small(evidence: UnitEvidence) -> float:
    """Return 57 when rates were turned from deg/s to rad/s once too often, else 1."""
    again = 1.0 / DEGREE
    return again if not evidence.rate_fits(1.0) and evidence.rate_fits(again) else 1.0


def clipped(values: FloatArray, least: float) -> int:
    """Count the samples (N, 3) at the end of the range: an extreme that stays for samples on end.

    A range that is not reached has an extreme that occurs once; one that is reached repeats it.
    ``least`` is the smallest value that can be the end of a range.
    """
    count = 0
    for column in values.T:
        for side in (column, -column):
            top = side == side.max(initial=-np.inf)
            held = top[1:] & top[:-1]
            if held.any() and side.max() > least:
                count += int(top.sum())
    return count


def _quantile(vectors: FloatArray, share: float) -> float:
    if not len(vectors):
        return float("nan")
    return float(np.quantile(np.linalg.norm(vectors, axis=1), share))
