"""Interleaved repetitions: every case in turn, so that a slow minute of the machine hits all."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass

from .cases import YARDSTICK, Case


@dataclass(frozen=True)
class Timing:
    """Cost of one case: median and least us an epoch, and its relation to the yardstick."""

    name: str
    median_us: float
    least_us: float
    faster_than_yardstick: float
    times_real_time: float

    def to_dict(self) -> dict[str, float | str]:
        """Return the figures by name."""
        return asdict(self)


def measure(
    cases: Sequence[Case], repetitions: int, rate_hz: float, progress: Callable[[], None]
) -> list[Timing]:
    """Run every case ``repetitions`` times; ratios are of the medians over the repetitions."""
    found: dict[str, list[float]] = {case.name: [] for case in cases}
    for _ in range(repetitions):
        for case in cases:
            seconds, epochs = case.run()
            found[case.name].append(1e6 * seconds / epochs)
            progress()
    yard = found[YARDSTICK]
    timings = []
    for name, costs in found.items():
        ratio = statistics.median(y / c for y, c in zip(yard, costs, strict=True))
        median = statistics.median(costs)
        timings.append(Timing(name, median, min(costs), ratio, 1e6 / rate_hz / median))
    return timings
