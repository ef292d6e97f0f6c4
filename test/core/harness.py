"""What the tests of the core share: walks, sessions that are followed epoch by epoch, vectors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from dualfoot_ros.core import ImuPair, ImuSeries, TrackerConfig
from dualfoot_ros.core.alignment import Alignment
from dualfoot_ros.core.compiler import compiled
from dualfoot_ros.core.kernel import Engine, interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.row_store import RowStore
from dualfoot_ros.core.samples.pair_series import PairSeries
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.core.session import Session
from dualfoot_ros.simulation import SensorConfig, WalkConfig, simulate

GRAVITY = 9.80665


@cache
def quick_engine() -> Engine:
    """Return the compiled kernel, or the interpreted one where numba is missing."""
    try:
        return compiled()
    except ImportError:
        return interpreted()


@dataclass(frozen=True)
class Pairs:
    """Synchronised samples: stamps (N,) ns and values (N, 12)."""

    stamps: np.ndarray
    values: np.ndarray

    def __len__(self) -> int:
        return len(self.stamps)

    def __getitem__(self, index) -> Pairs:
        return Pairs(self.stamps[index], self.values[index])

    def __iter__(self) -> Iterator[ImuPair]:
        return (ImuPair(int(s), v) for s, v in zip(self.stamps, self.values, strict=True))

    def series(self) -> tuple[ImuSeries, ImuSeries]:
        """Return the two series that `run` takes."""
        return tuple(
            ImuSeries(
                self.stamps, self.values[:, 6 * f : 6 * f + 3], self.values[:, 6 * f + 3 :][:, :3]
            )
            for f in range(2)
        )

    @property
    def dts(self) -> np.ndarray:
        """Intervals (N,) s that end at each sample."""
        return np.diff(self.stamps, prepend=self.stamps[:1]) * 1e-9


@cache
def simulated(
    route: str = "rectangle",
    rate: float = 60.0,
    standing: float = 4.0,
    final_standing: float = 2.0,
    seed: int = 3,
):
    """Return a simulated walk with a consumer sensor on each foot and perfect clocks."""
    config = WalkConfig(route=route, rate=rate, standing=standing, final_standing=final_standing)
    return simulate(config, SensorConfig(), seed=seed)


def walk(seconds: float | None = None, **options) -> Pairs:
    """Return the pairs of a simulated walk, its first ``seconds`` only if given."""
    made = simulated(**options)
    pairs = Pairs(made.left.stamp_ns, stack_pairs(made.left, made.right))
    return pairs if seconds is None else pairs[: round(seconds * options.get("rate", 60.0))]


def standing_samples(count: int, rate: float = 100.0, seed: int = 0) -> Pairs:
    """Return pairs of two level sensors at rest with a little noise."""
    rng = np.random.default_rng(seed)
    still = np.array([0.0, 0.0, GRAVITY, 0.0, 0.0, 0.0] * 2)
    values = still + rng.normal(size=(count, 12)) * np.repeat([0.01, 0.001, 0.01, 0.001], 3)
    return Pairs(np.arange(count) * round(1e9 / rate) + 10**18, values)


def open_session(
    config: TrackerConfig, pairs: Pairs, engine: Engine | None = None, seconds: float = 3.0
) -> tuple[Session, int]:
    """Align on the first ``seconds``; return the session and the index of the next sample.

    What comes after them refines the stand no more: its epochs follow each other as they are.
    """
    count = round(seconds * 1e9 / float(np.median(np.diff(pairs.stamps))))
    alignment, start = Alignment(config), None
    for stamp, row in zip(pairs.stamps[:count].tolist(), pairs.values[:count], strict=True):
        if start is None:
            start = alignment.add(stamp, row)
        elif alignment.refine(stamp, row):
            start = start._replace(feet=alignment.result())
    assert start is not None, alignment.complaint
    return Session(config, engine or quick_engine(), start), count


def follow(session: Session, pairs: Pairs, start: int) -> Iterator[tuple[int, list]]:
    """Run the pairs from ``start`` on, one epoch at a time; yield (epoch, events)."""
    series, rows = PairSeries.of(*pairs.series()), RowStore(len(pairs))
    for k in range(start, len(pairs)):
        found = [e for _, es in session.steps(series, (k, k + 1), rows) for e in es]
        yield session.space.epoch, found


def state_bits(w: np.ndarray) -> bytes:
    """Return what a snapshot holds (nominal states and covariance), as bytes."""
    return w[: lay.STATE].tobytes()


def cross_matrix(v) -> np.ndarray:
    """Return [v x]."""
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
