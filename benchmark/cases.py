"""What is timed: epochs of a simulated walk, by the tracker in its forms and by the yardstick."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dualfoot_ros.core import DualFootTracker, ImuPair, TrackerConfig
from dualfoot_ros.core.samples.series import ImuSeries, stack_pairs
from dualfoot_ros.simulation import WalkConfig, simulate

from .yardstick import DenseFilter

YARDSTICK = "yardstick"
YARDSTICK_EPOCHS = 1500
INTERPRETED_EPOCHS = 1500


@dataclass(frozen=True)
class Walk:
    """A simulated walk: the two series, and the same as pairs."""

    left: ImuSeries
    right: ImuSeries
    pairs: list[ImuPair]
    rate_hz: float

    @property
    def duration_s(self) -> float:
        """Length of the recording."""
        return self.left.duration_s


@dataclass(frozen=True)
class Case:
    """One thing to time: ``run`` returns seconds and epochs."""

    name: str
    run: Callable[[], tuple[float, int]]


def make_walk(rate_hz: float, laps: int) -> Walk:
    """Simulate laps of the rectangle with a consumer sensor on each foot."""
    made = simulate(WalkConfig(route="rectangle", laps=laps, rate=rate_hz, standing=4.0), seed=1)
    values = stack_pairs(made.left, made.right)
    pairs = [ImuPair(int(s), v) for s, v in zip(made.left.stamp_ns, values, strict=True)]
    return Walk(made.left, made.right, pairs, rate_hz)


def batch(walk: Walk, method: str) -> Case:
    """Time `run` over the whole walk, alignment and building of the trajectory included."""

    def run() -> tuple[float, int]:
        tracker = DualFootTracker(TrackerConfig(method=method), engine="compiled")
        start = time.perf_counter()
        tracker.run(walk.left, walk.right)
        return time.perf_counter() - start, len(walk.pairs)

    return Case(f"{method} batch", run)


def live(walk: Walk, method: str, engine: str = "compiled") -> Case:
    """Time `add`, one pair after another, with nobody asking for covariances."""
    pairs = walk.pairs
    if engine == "interpreted":
        start_of_walk = round(4.5 * walk.rate_hz)
        pairs = pairs[: start_of_walk + INTERPRETED_EPOCHS]

    def run() -> tuple[float, int]:
        tracker = DualFootTracker(TrackerConfig(method=method), engine=engine)
        add = tracker.add
        aligned = 0
        start = time.perf_counter()
        for pair in pairs:
            aligned += add(pair).row is not None
        return time.perf_counter() - start, len(pairs)

    return Case(f"{method} live" + (" interpreted" if engine == "interpreted" else ""), run)


def yardstick(walk: Walk) -> Case:
    """Time the dense filter over walking with every third sample a zero-velocity update."""
    first = round(6.0 * walk.rate_hz)
    samples = [pair.values for pair in walk.pairs[first : first + YARDSTICK_EPOCHS]]
    dt = 1.0 / walk.rate_hz

    def run() -> tuple[float, int]:
        dense = DenseFilter(TrackerConfig())
        start = time.perf_counter()
        for k, sample in enumerate(samples):
            dense.epoch(dt, sample, (k % 3 == 0, k % 3 == 1))
        seconds = time.perf_counter() - start
        assert np.isfinite(dense.P).all()
        return seconds, len(samples)

    return Case(YARDSTICK, run)
