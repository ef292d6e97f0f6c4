"""Clocks that were set during a walk: their stamps are moved, so that it is one recording.

The clock after a step is that before it, set by an unknown amount.  The samples themselves tell
it: one usual interval lies between the last one before and the first one after the step.  A step
ahead of both feet is left as a hole.  So is one of a single foot, unless the ends of both feet lie
as their beginnings do once the step is taken off: then no samples were lost in it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..core import FEET, LOOP_NS, ImuSeries, IntArray, PoseSeries
from ..recording import ClockStep, Recording
from ..timing import AlignerConfig, clean

REGULAR = 20  # intervals before a step, all of them without a hole
ALIKE_NS = 100_000_000  # by so much the steps of both feet may differ: samples were lost there
LOST = 2.5  # usual intervals by which the ends of the feet may differ if none was lost
MOST = 10  # steps of a recording


@dataclass(frozen=True)
class _Step:
    """A step of the stamps of one foot.

    ``index`` is the first sample after it, ``newest_ns`` the stamp before, and ``by_ns`` how far
    the clock was set back (negative: ahead) if no sample is missing; ``usual_ns`` is the interval
    of the samples.
    """

    index: int
    newest_ns: int
    by_ns: int
    usual_ns: int


def mend_clocks(recording: Recording) -> Recording:
    """Return the recording with the stamps after each step of a clock moved to follow on.

    So it is done where both feet step back at one place by the same amount, and go on for good:
    both are moved alike, and so are truth and air pressure that make the same step.  A foot that
    steps alone is moved where it ends with the other one as it begins.  Stamps that come back to
    the start are those of another recording.  Where one of the steps is none of these, the
    recording is returned as it is, to be refused, and so is one without any.  One step ahead of
    one foot alone is moved as well.
    """
    mended = recording
    for _ in range(MOST + 1):
        steps = _steps_back(mended)
        sure = {foot: step for foot, step in steps.items() if step is not None}
        if not steps:
            return _set_ahead(mended)
        if len(sure) < len(steps):
            return recording
        by_ns = _by_both(sure) if len(sure) == len(FEET) else _by_one(mended, sure)
        if by_ns is None:
            return recording
        mended = _moved(mended, sure, by_ns)
    return recording


def _set_ahead(recording: Recording) -> Recording:
    """Return the recording with one step ahead of one foot's clock taken off, if there is one."""
    for foot in FEET:
        series, other = recording.imu(foot), recording.imu(_other(foot))
        if not series or not other or len(series) <= REGULAR:
            continue
        steps = np.diff(series.stamp_ns)
        index, usual_ns = int(np.argmax(steps)), int(np.median(steps))
        ahead = _Step(
            index + 1, int(series.stamp_ns[index]), usual_ns - int(steps[index]), usual_ns
        )
        by_ns = _by_one(recording, {foot: ahead}) if (steps >= 0).all() else None
        if by_ns is not None:
            return _moved(recording, {foot: ahead}, by_ns)
    return recording


def _other(foot: str) -> str:
    return next(each for each in FEET if each != foot)


def _steps_back(recording: Recording) -> dict[str, _Step | None]:
    """Return the first step of each foot that goes back for good, None for one that is unsure."""
    steps = {}
    for foot in FEET:
        series = recording.imu(foot)
        if series is None or not (np.diff(series.stamp_ns) < 0).any():
            continue
        good, _, restart_at = clean(series)
        if restart_at is not None:
            steps[foot] = _describe(series, int(good.stamp_ns[-1]), restart_at)
    return steps


def _describe(series: ImuSeries, newest_ns: int, restart_at: int) -> _Step | None:
    """Return the step from ``newest_ns`` back, seen at ``restart_at``; None where it is unsure."""
    stamps = series.stamp_ns
    index = int(np.flatnonzero(stamps[:restart_at] == newest_ns)[-1]) + 1
    before = np.diff(stamps[max(0, index - REGULAR - 1) : index])
    whole = (before > 0) & (before <= AlignerConfig().max_gap_ns)
    anew = abs(int(stamps[index] - stamps[0])) < LOOP_NS
    if anew or len(before) < REGULAR or not whole.all():
        return None
    usual_ns = int(np.median(before))
    return _Step(index, newest_ns, newest_ns + usual_ns - int(stamps[index]), usual_ns)


def _by_both(steps: Mapping[str, _Step]) -> int | None:
    """Return by how much the clock of both feet was set back, None where it was not one.

    A foot that lost samples there seems to step by less.
    """
    left, right = (steps[foot] for foot in FEET)
    together = abs(left.newest_ns - right.newest_ns) <= AlignerConfig().max_delay_ns
    alike = abs(left.by_ns - right.by_ns) <= ALIKE_NS
    return max(left.by_ns, right.by_ns) if together and alike else None


def _by_one(recording: Recording, steps: Mapping[str, _Step]) -> int | None:
    """Return by how much the clock of one foot was set, None where it is not sure."""
    ((foot, step),) = steps.items()
    other = recording.imu(_other(foot))
    own = recording.imu(foot)
    assert own is not None
    if abs(step.by_ns) <= AlignerConfig().max_delay_ns:
        return None
    if not other:
        return step.by_ns
    begins_ns = int(own.stamp_ns[0] - other.stamp_ns[0])
    ends_ns = int(own.stamp_ns[-1] + step.by_ns - other.stamp_ns[-1])
    return step.by_ns if abs(ends_ns - begins_ns) <= LOST * step.usual_ns else None


def _moved(recording: Recording, steps: Mapping[str, _Step], by_ns: int) -> Recording:
    """Return the recording with everything that makes these steps moved by ``by_ns``."""
    at_ns = max(step.newest_ns for step in steps.values())
    feet = {}
    for foot, step in steps.items():
        series = recording.imu(foot)
        assert series is not None
        feet[foot] = replace(series, stamp_ns=_later(series.stamp_ns, step.index, by_ns))
    truths = {foot: _moved_truth(recording.truth(foot), at_ns, by_ns) for foot in FEET}
    pressure = {
        worn: replace(series, stamp_ns=_in_step(series.stamp_ns, at_ns, by_ns))
        for worn, series in recording.pressure.items()
    }
    cut = any(len(truths[f] or ()) < len(recording.truth(f) or ()) for f in FEET)
    first_ns = min(int(s.stamp_ns[0]) for foot in FEET if (s := recording.imu(foot)))
    told = ClockStep(tuple(steps), at_ns, by_ns, at_ns - first_ns, cut)
    return replace(
        recording,
        left=feet.get("left", recording.left),
        right=feet.get("right", recording.right),
        left_truth=truths["left"],
        right_truth=truths["right"],
        pressure=pressure,
        clock_steps=(*recording.clock_steps, told),
    )


def _moved_truth(truth: PoseSeries | None, at_ns: int, by_ns: int) -> PoseSeries | None:
    """Return the truth moved where it makes the same step; where it makes another, its start."""
    if truth is None or not len(truth):
        return truth
    stamps = _in_step(truth.stamp_ns, at_ns, by_ns)
    back = np.flatnonzero(np.diff(stamps) < 0)
    if not len(back) or stamps[back[0]] > at_ns + ALIKE_NS:
        return replace(truth, stamp_ns=stamps)
    part = slice(int(back[0]) + 1)
    velocity = None if truth.velocity is None else truth.velocity[part]
    return PoseSeries(stamps[part], truth.position[part], truth.quaternion[part], velocity)


def _in_step(stamp_ns: IntArray, at_ns: int, by_ns: int) -> IntArray:
    """Return stamps moved where they make the step of ``by_ns`` near ``at_ns``."""
    steps = np.diff(stamp_ns)
    if not len(steps):
        return stamp_ns
    usual_ns = int(np.median(steps))
    slack_ns = max(ALIKE_NS, 2 * usual_ns)
    alike = ((steps < 0) == (by_ns > 0)) & (np.abs(steps + by_ns - usual_ns) <= slack_ns)
    near = np.abs(stamp_ns[:-1] - at_ns) <= slack_ns + AlignerConfig().max_delay_ns
    found = np.flatnonzero(alike & near)
    return _later(stamp_ns, int(found[0]) + 1, by_ns) if len(found) else stamp_ns


def _later(stamp_ns: IntArray, index: int, by_ns: int) -> IntArray:
    """Return the stamps with those from ``index`` on later by ``by_ns``."""
    moved = stamp_ns.copy()
    moved[index:] += by_ns
    return moved
