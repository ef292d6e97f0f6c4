"""Finding on the sampling rate that a tracker uses, where it is not that of its samples."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core import EventKind, IntArray, Trajectory, median
from .finding import Finding, Severity
from .finding_kinds import FindingKind

TOLERANCE = 0.1
LONGEST_S = 0.2  # longer intervals are holes
UNEVEN = 0.2  # by which mean and median interval differ where stamps are bunched
LEAST = 100  # intervals


def seen_rate_hz(stamp_ns: IntArray) -> float | None:
    """Return the rate of samples with stamps (N,) ns; None for too few of them.

    It is that of the median interval, or of the mean where stamps are bunched.
    """
    steps = np.diff(stamp_ns) * 1e-9
    steps = steps[(steps > 0.0) & (steps < LONGEST_S)]
    if len(steps) < LEAST:
        return None
    mean, usual = float(steps.mean()), median(steps)
    return 1.0 / (usual if abs(usual - mean) <= UNEVEN * mean else mean)


def find_other_rate(used_hz: float, stamp_ns: IntArray) -> Iterator[Finding]:
    """Yield a finding when samples with stamps (N,) ns do not come at the rate that is used."""
    seen_hz = seen_rate_hz(stamp_ns)
    if seen_hz is None or abs(seen_hz - used_hz) <= TOLERANCE * used_hz:
        return
    yield Finding(
        FindingKind.RATE_USED,
        Severity.WARNING,
        f"the tracker uses a rate of {used_hz:.1f} Hz, that of its start, where {seen_hz:.1f} Hz "
        "are seen: windows of the stance detector and noise are those of the other rate",
        "keep the rate of the sensors; live, the service reset of fusion takes the new one",
    )


def rate_findings(trajectory: Trajectory) -> Iterator[Finding]:
    """Yield a finding when a walk was tracked at another rate than that of its samples."""
    starts = [event for event in trajectory.events if event.kind is EventKind.ALIGNED]
    if starts:
        yield from find_other_rate(float(starts[-1].detail["rate"]), trajectory.left.stamp_ns)
