"""Two whole recordings on one grid: the aligner's pairs, computed on arrays.

The result is that of :class:`dualfoot_ros.timing.Aligner`, bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...core import FEET, BoolArray, ImuSeries, IntArray, TimingError
from .grid_lookup import GridLookup
from .pairing_config import AlignerConfig
from .stream_gate import Clean, clean


@dataclass(frozen=True)
class AlignReport:
    """What became of the samples; ``counters`` are those of the streaming aligner.

    ``overlap_s`` is the time during which both feet were on; not positive when they never were.
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
    ``config.max_gap``.  Samples with stamps that do not increase or values that are not finite are
    left out and counted.  Feet that never were on at the same time give empty series.

    Raises
    ------
    TimingError
        When the stamps of a foot jump back and go on from there: two recordings in one.
    """
    config = config or AlignerConfig()
    found = {"left": clean(left, config), "right": clean(right, config)}
    feet = {foot: _increasing(foot, found[foot]) for foot in FEET}
    grid = _grid(feet, config)
    lookups = [GridLookup.of(feet[foot].stamp_ns, grid, config) for foot in FEET]
    good = lookups[0].found & lookups[1].found
    taken = [p.take(feet[f], grid, good) for f, p in zip(FEET, lookups, strict=True)]
    counters = {f"{f}_{k}": n for f in FEET for k, n in found[f].counters.items()}
    counters |= _outcomes(lookups, good)
    return taken[0], taken[1], AlignReport(counters, _overlap_s(feet))


def _increasing(foot: str, found: Clean) -> ImuSeries:
    if found.restart_at is None:
        return found.series
    raise TimingError(
        f"the stamps of the {foot} foot jump back and go on from there (seen at sample "
        f"{found.restart_at}): two recordings in one; cut it there"
    )


def _grid(feet: Mapping[str, ImuSeries], config: AlignerConfig) -> IntArray:
    if not all(len(series) for series in feet.values()):
        return np.empty(0, dtype=np.int64)
    if config.rate == 0:
        return feet[config.reference].stamp_ns
    start = max(int(series.stamp_ns[0]) for series in feet.values())
    numbers = _numbers(feet["left"].stamp_ns, start, config)
    grid = start + np.rint(numbers * 1e9 / config.rate).astype(np.int64)
    end = min(int(series.stamp_ns[-1]) for series in feet.values())
    common: IntArray = grid[grid <= end + config.tolerance_ns]
    return common


def _numbers(stamp_ns: IntArray, start: int, config: AlignerConfig) -> IntArray:
    """Return the numbers of the grid stamps that can be within the runs between the holes."""
    cuts = np.flatnonzero(np.diff(stamp_ns) > config.max_gap_ns) + 1
    runs = [run for run in np.split(stamp_ns, cuts) if run[-1] >= start - config.tolerance_ns]
    ranges = []
    for run in runs:
        first, last = ((int(t) - start) * config.rate * 1e-9 for t in (run[0], run[-1]))
        ranges.append(np.arange(max(0, int(first) - 2), int(last) + 3))
    return np.unique(np.concatenate(ranges)) if ranges else np.empty(0, dtype=np.int64)


def _outcomes(lookups: list[GridLookup], good: BoolArray) -> dict[str, int]:
    outside = (lookups[0].outside | lookups[1].outside) & ~good
    interpolated = (lookups[0].between | lookups[1].between) & good
    return {
        "pairs": int(good.sum()),
        "interpolated": int(interpolated.sum()),
        "in_gap": int((~good & ~outside).sum()),
        "late": 0,
        "outside": int(outside.sum()),
        "restarts": 0,
    }


def _overlap_s(feet: Mapping[str, ImuSeries]) -> float:
    if not all(len(series) for series in feet.values()):
        return 0.0
    start = max(int(series.stamp_ns[0]) for series in feet.values())
    end = min(int(series.stamp_ns[-1]) for series in feet.values())
    return (end - start) * 1e-9
