"""Two whole recordings on one grid: the aligner's pairs, computed on arrays.

The result is that of :class:`dualfoot_ros.timing.Aligner`, bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ...core import FEET, BoolArray, ImuSeries, IntArray, TimingError
from .grid import anchor
from .grid_lookup import GridLookup
from .lost_samples import Restored
from .pairing_config import AlignerConfig
from .stream_gate import Clean, clean


class AlignReport(NamedTuple):
    """What became of the samples; ``counters`` are those of the streaming aligner.

    ``overlap_s`` is the time during which both feet were on; not positive when they never were.
    ``interpolated`` counts the pairs in which a foot was, and ``left_missing`` those without it.
    """

    counters: Mapping[str, int]
    overlap_s: float

    @property
    def shared_stamps(self) -> bool:
        """Whether both feet had equal stamps already and passed through unchanged."""
        return self.counters["pairs"] > 0 and self.counters["interpolated"] == 0


def align(
    left: ImuSeries, right: ImuSeries, config: AlignerConfig | None = None
) -> tuple[ImuSeries, ImuSeries]:
    """Return both series on one grid with equal stamps; see :func:`align_with_report`."""
    return align_with_report(left, right, config)[:2]


def align_with_report(
    left: ImuSeries, right: ImuSeries, config: AlignerConfig | None = None
) -> tuple[ImuSeries, ImuSeries, AlignReport]:
    """Return both series on one grid with equal stamps, and what became of their samples.

    Values are interpolated (or held, ``config.between``), never across more than
    ``config.max_gap``.  Where a foot has a longer hole, has not begun or has ended, its rows are
    NaN and the stamps are those of the other foot.  Samples with stamps that do not increase or
    values that are not finite are left out and counted.

    Raises
    ------
    TimingError
        When the stamps of a foot jump back and go on from there: two recordings in one.
    """
    config = config or AlignerConfig()
    found = {"left": clean(left, config), "right": clean(right, config)}
    feet = {foot: _increasing(foot, found[foot]) for foot in FEET}
    whole = {foot: Restored.of(feet[foot], config) for foot in FEET}
    grid = _grid(whole, config)
    lookups = [GridLookup.of(w.series.stamp_ns, grid, config, w.lost) for w in whole.values()]
    kept = (lookups[0].found | lookups[1].found) & ~_outside(feet, grid, lookups, config)
    taken = [p.take(whole[f].series, grid, kept) for f, p in zip(FEET, lookups, strict=True)]
    counters = {f"{f}_{k}": n for f in FEET for k, n in found[f].counters.items()}
    counters |= dict.fromkeys((f"{foot}_clock_set" for foot in FEET), 0)
    counters |= _outcomes(lookups, kept)
    return taken[0], taken[1], AlignReport(counters, _overlap_s(feet))


def _increasing(foot: str, found: Clean) -> ImuSeries:
    if found.restart_at is None:
        return found.series
    raise TimingError(
        f"the stamps of the {foot} foot jump back and go on from there (seen at sample "
        f"{found.restart_at}): two recordings in one; cut it there"
    )


def _grid(feet: Mapping[str, Restored], config: AlignerConfig) -> IntArray:
    """Return the stamps at which pairs are wanted, before those that no foot has are left out."""
    stamps = {foot: whole.stamp_ns for foot, whole in feet.items()}
    if config.rate == 0:
        own = stamps.pop(config.reference)
        other = next(iter(stamps.values()))
        alone = other[~GridLookup.of(own, other, config).found]
        return np.sort(np.concatenate([own, alone]))
    on = [each for each in stamps.values() if len(each)]
    if not on:
        return np.empty(0, dtype=np.int64)
    start = anchor([int(each[0]) for each in on], config)
    numbers = np.unique(np.concatenate([_numbers(each, start, config) for each in on]))
    grid = start + np.rint(numbers * 1e9 / config.rate).astype(np.int64)
    common: IntArray = grid[grid <= max(int(each[-1]) for each in on) + config.tolerance_ns]
    return common


def _numbers(stamp_ns: IntArray, start: int, config: AlignerConfig) -> IntArray:
    """Return the numbers of the grid stamps that can be within the runs between the holes."""
    cuts = np.flatnonzero(np.diff(stamp_ns) > config.max_gap_ns) + 1
    runs = [run for run in np.split(stamp_ns, cuts) if run[-1] >= start - config.tolerance_ns]
    ranges = []
    for run in runs:
        first, last = ((int(t) - start) * config.rate * 1e-9 for t in (run[0], run[-1]))
        ranges.append(np.arange(max(0, int(first) - 2), int(last) + 3))
    return np.concatenate(ranges) if ranges else np.empty(0, dtype=np.int64)


def _outside(
    feet: Mapping[str, ImuSeries],
    grid: IntArray,
    lookups: list[GridLookup],
    config: AlignerConfig,
) -> BoolArray:
    """Return (N,) where one foot begins or ends a moment later or earlier than the other."""
    dropped = np.zeros(len(grid), dtype=bool)
    if not all(len(series) for series in feet.values()):
        return dropped
    for end, side in ((0, np.less), (-1, np.greater)):
        left, right = (int(feet[foot].stamp_ns[end]) for foot in FEET)
        if abs(left - right) <= config.max_gap_ns:
            for foot, lookup in zip(FEET, lookups, strict=True):
                dropped |= lookup.outside & side(grid, feet[foot].stamp_ns[end])
    return dropped


def _outcomes(lookups: list[GridLookup], kept: BoolArray) -> dict[str, int]:
    found = lookups[0].found | lookups[1].found
    interpolated = (lookups[0].interpolated | lookups[1].interpolated) & kept
    missing = {
        f"{foot}_missing": int((kept & ~lookup.found).sum())
        for foot, lookup in zip(FEET, lookups, strict=True)
    }
    return {
        "pairs": int(kept.sum()),
        **missing,
        "interpolated": int(interpolated.sum()),
        "in_gap": int((~found).sum()),
        "late": 0,
        "outside": int((found & ~kept).sum()),
        "restarts": 0,
    }


def _overlap_s(feet: Mapping[str, ImuSeries]) -> float:
    if not all(len(series) for series in feet.values()):
        return 0.0
    start = max(int(series.stamp_ns[0]) for series in feet.values())
    end = min(int(series.stamp_ns[-1]) for series in feet.values())
    return (end - start) * 1e-9
