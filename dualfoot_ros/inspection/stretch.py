"""The last seconds of a live stream, inspected by the same functions as a recording."""

from __future__ import annotations

import struct
from collections.abc import Iterator

import numpy as np

from ..core import FEET, DualFootError, DualFootTracker, FloatArray, ImuSeries, TrackerConfig
from ..recording import Recording
from ..timing import align
from .findings import Finding, FindingKind, findings_of, walk_findings
from .stance_statistics import unconstrained_config

WALK_S = 60.0  # of a walk with turns, to tell exchanged feet
SIGNALS_S = 20.0  # of samples, to tell a wrong sensor
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


ROW = np.dtype([("stamp_ns", "i8"), ("values", "f8", 6)])
STAMP = struct.Struct("q")


class Stretch:
    """The samples of the last WALK_S seconds of both feet.

    ``add`` is cheap, for every sample; ``take`` returns a recording that does not change any more,
    so that another thread can inspect it.
    """

    def __init__(self, length_s: float = WALK_S) -> None:
        """Keep ``length_s`` seconds of samples."""
        self._length_ns = round(1e9 * length_s)
        self._rows = {foot: bytearray() for foot in FEET}  # each sample as a ROW
        self._newest_ns: dict[str, int] = {}

    def add(self, foot: str, stamp_ns: int, values: FloatArray) -> None:
        """Take specific force and angular rate (6,) of one sample."""
        rows = self._rows[foot]
        if abs(stamp_ns - self._newest_ns.get(foot, stamp_ns)) > LONG_NS:
            rows.clear()
        rows += STAMP.pack(stamp_ns) + values.tobytes()
        self._newest_ns[foot] = stamp_ns
        while STAMP.unpack_from(rows)[0] < stamp_ns - self._length_ns:
            del rows[: ROW.itemsize]

    @property
    def newest_ns(self) -> int:
        """The newest stamp of either foot; 0 before the first."""
        return max(self._newest_ns.values(), default=0)

    def clear(self) -> None:
        """Forget everything."""
        self._newest_ns.clear()
        for rows in self._rows.values():
            rows.clear()

    def take(self, length_s: float = WALK_S) -> Recording:
        """Return the last ``length_s`` s as a recording."""
        left, right = (_series(bytes(self._rows[foot]), length_s) for foot in FEET)
        return Recording(left, right)


def _series(rows: bytes, length_s: float) -> ImuSeries | None:
    """Return the last ``length_s`` s of the samples that are possible; others are counted."""
    if not rows:
        return None
    samples = np.frombuffer(rows, dtype=ROW)
    stamps, values = samples["stamp_ns"], samples["values"]
    usable = (np.abs(values) < LARGEST).all(axis=1)
    usable &= stamps >= stamps[-1] - round(1e9 * length_s)
    return ImuSeries(stamps[usable], values[usable, :3], values[usable, 3:])


def signal_findings(stretch: Recording) -> Iterator[Finding]:
    """Yield the findings on the sensors of a stretch of a live stream."""
    if _is_long_enough(stretch):
        yield from (found for found in findings_of(stretch) if found.kind in OF_STREAM)


def track_findings(stretch: Recording, config: TrackerConfig) -> Iterator[Finding]:
    """Yield what the tracks of a stretch show; nothing where it gives no start.

    ``config`` is that of the live tracker.  Each foot is tracked by itself with the compiled
    kernel.
    """
    left, right = stretch.left, stretch.right
    if left is None or right is None or not _is_long_enough(stretch):
        return
    tracker = DualFootTracker(unconstrained_config(config), engine="compiled")
    try:
        trajectory = tracker.run(*align(left, right))
    except DualFootError:
        return
    yield from walk_findings(trajectory)


def _is_long_enough(stretch: Recording) -> bool:
    feet = [foot for foot in (stretch.left, stretch.right) if foot is not None and len(foot)]
    return bool(feet) and min(foot.duration_s for foot in feet) >= LEAST_S
