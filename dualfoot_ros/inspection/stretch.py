"""The last seconds of a live stream, inspected by the same functions as a recording."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

import numpy as np

from ..core import FEET, DualFootError, DualFootTracker, FloatArray, ImuSeries, TrackerConfig
from ..recording import Recording
from ..timing import align
from .findings import Finding, FindingKind, findings_of, walk_findings
from .stance_statistics import unconstrained_config

STRETCH_S = 60.0  # of a walk with turns, to tell exchanged feet
LEAST_S = 4.0  # a shorter stretch is not inspected
LONG_NS = 3_600_000_000_000  # a jump of the stamps beyond this begins anew
LARGEST = 1e5  # no reading of a sensor in any unit is larger
OF_STREAM = frozenset(
    {
        FindingKind.SAME_SAMPLES,
        FindingKind.GRAVITY,
        FindingKind.FORCE_UNIT,
        FindingKind.RATE_UNIT,
        FindingKind.RATE_AXES,
        FindingKind.RATE_SCALE,
        FindingKind.RATE_MISFIT,
        FindingKind.STUCK,
        FindingKind.CLIPPING,
        FindingKind.MISSING_SAMPLES,
        FindingKind.JITTER,
        FindingKind.LOW_RATE,
    }
)
"""Kinds of findings on a recording that say something of a stretch of it."""


class Stretch:
    """The samples of the last STRETCH_S seconds of both feet.

    ``add`` is cheap, for every sample; ``take`` returns a recording that does not change any more,
    so that another thread can inspect it with `stretch_findings`.
    """

    def __init__(self, length_s: float = STRETCH_S) -> None:
        """Keep ``length_s`` seconds of samples."""
        self._length_ns = round(1e9 * length_s)
        self._samples: dict[str, deque[tuple[int, FloatArray]]] = {f: deque() for f in FEET}

    def add(self, foot: str, stamp_ns: int, values: FloatArray) -> None:
        """Take specific force and angular rate (6,) of one sample."""
        samples = self._samples[foot]
        if samples and abs(stamp_ns - samples[-1][0]) > LONG_NS:
            samples.clear()
        samples.append((stamp_ns, values))
        while samples[0][0] < stamp_ns - self._length_ns:
            samples.popleft()

    @property
    def newest_ns(self) -> int:
        """The newest stamp of either foot; 0 before the first."""
        return max((s[-1][0] for s in self._samples.values() if s), default=0)

    def clear(self) -> None:
        """Forget everything."""
        for samples in self._samples.values():
            samples.clear()

    def take(self) -> Recording:
        """Return the stretch as a recording."""
        left, right = (_series(list(self._samples[foot])) for foot in FEET)
        return Recording(left, right)


def _series(samples: list[tuple[int, FloatArray]]) -> ImuSeries | None:
    if not samples:
        return None
    values = np.array([values for _, values in samples])
    stamps = np.array([stamp_ns for stamp_ns, _ in samples], dtype=np.int64)
    possible = (np.abs(values) < LARGEST).all(axis=1)  # the others are refused, and counted
    return ImuSeries(stamps[possible], values[possible, :3], values[possible, 3:])


def stretch_findings(
    stretch: Recording, config: TrackerConfig, *, track: bool = True
) -> Iterator[Finding]:
    """Yield the findings on a stretch of a live stream.

    ``config`` is that of the live tracker.  With ``track`` each foot is tracked by itself with the
    compiled kernel, and what the walk shows is told too.
    """
    left, right = stretch.left, stretch.right
    feet = [series for series in (left, right) if series is not None and len(series)]
    if not feet or min(series.duration_s for series in feet) < LEAST_S:
        return
    yield from (found for found in findings_of(stretch) if found.kind in OF_STREAM)
    if track and left is not None and right is not None:
        yield from _walk(left, right, config)


def _walk(left: ImuSeries, right: ImuSeries, config: TrackerConfig) -> Iterator[Finding]:
    """Yield what the tracks of a stretch show; nothing where it gives no start."""
    tracker = DualFootTracker(unconstrained_config(config), engine="compiled")
    try:
        trajectory = tracker.run(*align(left, right))
    except DualFootError:
        return
    yield from walk_findings(trajectory)
