"""Where the stamps of a grid lie among the samples of one foot."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...core import BoolArray, FloatArray, ImuSeries, IntArray, new_array
from .interpolation import between_rows
from .pairing_config import AlignerConfig

TOGETHER = 1 << 12  # stamps at once: what they need stays in the cache of the processor


class GridLookup(NamedTuple):
    """For each stamp of the grid the samples around it, and which rule gives its value.

    Attributes
    ----------
    before, after : (N,) index of the last sample at or before, and of the one after it; where
        ``exact``, ``before`` is the sample that is taken
    weight : (N,) share of ``after`` in the value
    width_s : (N,) s, time between the two
    exact : (N,) a sample is within the tolerance and taken as it is
    lost : (N,) that sample was lost, and is made of those around it
    between : (N,) interpolated, or the earlier one held
    outside : (N,) before the first or after the last sample
    """

    before: IntArray
    after: IntArray
    weight: FloatArray
    width_s: FloatArray
    exact: BoolArray
    lost: BoolArray
    between: BoolArray
    outside: BoolArray

    @classmethod
    def of(
        cls, stamps: IntArray, grid: IntArray, config: AlignerConfig, lost: BoolArray | None = None
    ) -> GridLookup:
        """Place ``grid`` among increasing ``stamps``, of which some are of ``lost`` samples."""
        if not len(stamps):
            return cls._nowhere(len(grid))
        if np.array_equal(stamps, grid):
            return cls._everywhere(stamps, lost)
        kinds = np.int64, np.int64, np.float64, np.float64, bool, bool, bool, bool
        whole = cls(*(new_array(grid.shape, kind) for kind in kinds))
        for start in range(0, len(grid), TOGETHER):
            part = slice(start, start + TOGETHER)
            some = cls._of_some(stamps, grid[part], config, lost)
            for values, found in zip(whole, some, strict=True):
                values[part] = found
        return whole

    @classmethod
    def _of_some(
        cls, stamps: IntArray, grid: IntArray, config: AlignerConfig, lost: BoolArray | None
    ) -> GridLookup:
        before = np.searchsorted(stamps, grid, side="right") - 1
        inside = (before >= 0) & (before + 1 < len(stamps))
        low = np.maximum(before, 0)
        high = np.minimum(before + 1, len(stamps) - 1)
        on_low = np.abs(grid - stamps[low]) <= config.tolerance_ns
        on_high = np.abs(stamps[high] - grid) <= config.tolerance_ns
        exact = on_low | on_high
        width = stamps[high] - stamps[low]
        width_s = width.astype(np.float64) * 1e-9
        between = inside & ~exact & (width <= config.max_gap_ns)
        since = np.zeros(len(grid)) if config.holds else grid - stamps[low]
        weight = since / np.where(between, width, 1)
        taken = np.where(on_high & ~on_low, high, low)
        made = np.zeros(len(grid), dtype=bool) if lost is None else exact & lost[taken]
        return cls(taken, high, weight, width_s, exact, made, between, ~inside & ~exact)

    @classmethod
    def _nowhere(cls, count: int) -> GridLookup:
        """Return the lookup among no samples at all."""
        none, zeros = np.zeros(count, dtype=bool), np.zeros(count, dtype=np.int64)
        return cls(zeros, zeros, np.zeros(count), np.zeros(count), none, none, none, ~none)

    @classmethod
    def _everywhere(cls, stamps: IntArray, lost: BoolArray | None) -> GridLookup:
        """Return the lookup of a grid that is the stamps themselves."""
        count, last = len(stamps), len(stamps) - 1
        here, none = np.arange(count), np.zeros(count, dtype=bool)
        width_s = np.diff(stamps, append=stamps[last:]) * 1e-9
        made = none if lost is None else lost
        return cls(
            here, np.minimum(here + 1, last), np.zeros(count), width_s, ~none, made, none, none
        )

    @property
    def found(self) -> BoolArray:
        """Where the foot has a value."""
        return self.exact | self.between

    @property
    def interpolated(self) -> BoolArray:
        """Where the value is made of samples at other times."""
        return self.between | self.lost

    def take(self, series: ImuSeries, grid: IntArray, kept: BoolArray) -> ImuSeries:
        """Return the series at the ``kept`` stamps of the grid, NaN where there is no value.

        Where it has a sample at each of them, and no others, that is the series itself.
        """
        if self._takes_all(series, kept):
            return replace(series, stamp_ns=grid)
        field = series.magnetic_field
        force, rate = (new_array((int(kept.sum()), 3)) for _ in range(2))
        force[:], rate[:] = np.nan, np.nan
        rows, good = np.flatnonzero(self.found[kept]), np.flatnonzero(kept & self.found)
        for start in range(0, len(good), TOGETHER):
            part = slice(start, start + TOGETHER)
            values = self._between(series, good[part])
            force[rows[part]], rate[rows[part]] = values[:, :3], values[:, 3:]
        return ImuSeries(
            grid[kept],
            force,
            rate,
            None if field is None else self._values(field, kept),
            series.increments,
        )

    def _takes_all(self, series: ImuSeries, kept: BoolArray) -> bool:
        """Return whether each sample has its own stamp of the grid, and each stamp its sample."""
        if len(series) != len(kept) or not (kept.all() and self.exact.all()):
            return False
        return np.array_equal(self.before, np.arange(len(kept)))

    def _between(self, series: ImuSeries, at: IntArray) -> FloatArray:
        """Return force and rate (K, 6) at places (K,) of the grid at which they are known."""
        exact = self.exact[at]
        before = _force_and_rate(series, self.before[at])
        if exact.all():  # the samples themselves, as of a foot whose stamps the grid has
            return before
        after = _force_and_rate(series, self.after[at])
        inside = between_rows(before, after, self.weight[at], self.width_s[at])
        return np.where(exact[:, None], before, inside)

    def _values(self, column: FloatArray, kept: BoolArray) -> FloatArray:
        values = np.full((int(kept.sum()), 3), np.nan)
        there, good = self.found[kept], kept & self.found
        before, after = column[self.before[good]], column[self.after[good]]
        line = before + (after - before) * self.weight[good][:, None]
        values[there] = np.where(self.exact[good][:, None], before, line)
        return values


def _force_and_rate(series: ImuSeries, rows: IntArray) -> FloatArray:
    return np.hstack([series.specific_force[rows], series.angular_rate[rows]])
