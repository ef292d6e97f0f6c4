"""Samples that are missing: short holes are filled, longer ones are got over."""

from __future__ import annotations

from collections.abc import Callable

from ..kernel import layout as lay
from ..results.events import FEET, Event, EventKind
from ..results.update import Update
from ..samples.pair_gate import MAX_GAP_NS
from ..samples.series import FloatArray
from .absence import Presence
from .notices import Found
from .walk_state import WalkState

Step = Callable[[int, float, FloatArray], Update | None]
LONGEST_STEP = 1.7  # of the nominal interval: longer ones are holes


class Holes:
    """Gets a walk over what is missing; ``step`` runs one epoch of it.

    Attributes
    ----------
    period_ns : nominal interval of the samples
    longest_ns : interval between two samples above which some are missing between them
    filled_ns : interval that remains to be run after `fill`
    """

    def __init__(self, walk: WalkState, step: Step) -> None:
        self._walk, self._step = walk, step
        self._rate_hz = walk.space.rate_hz
        self.period_ns = round(1e9 / self._rate_hz)
        self.longest_ns = min(round(LONGEST_STEP * 1e9 / self._rate_hz), MAX_GAP_NS)
        walk.space.n[lay.N_LONGEST] = self.longest_ns
        self.filled_ns = 0

    def fill(self, stamp: int, dt_ns: int, values: FloatArray) -> Found:
        """Run epochs on the line between the sample before and that of ``stamp`` (12,).

        What they cannot know of the motion goes into the covariance.  The newest sample itself
        remains to be run, with an interval of ``filled_ns``.
        """
        space = self._walk.space
        start = lay.RINGS + lay.SAMPLE * (space.epoch % space.ring) + 1
        before = space.w[start : start + 12].copy()
        count = max(1, round(dt_ns * 1e-9 * self._rate_hz))
        self.filled_ns = dt_ns // count
        found: Found = []
        for k in range(1, count):
            between = before + (values - before) * (k / count)
            at = stamp - (count - k) * self.filled_ns
            update = self._step(at, self.filled_ns * 1e-9, between)
            found += () if update is None else update.announced
        if count > 1:
            space.blur(dt_ns * 1e-9 - 1.0 / self._rate_hz, values - before)
        return found

    def bridge(self, gap_s: float) -> Found:
        """Get over a gap in the data: nothing is known of what the feet did meanwhile."""
        walk = self._walk
        last = walk.gait.stamp(walk.space.epoch)
        until = last + round(gap_s * 1e9)
        found: Found = []
        for foot in range(2):
            standing = walk.space.foot(foot, "N_PHASE") in (lay.STANCE, lay.LEAVING)
            if standing:
                found.append(Event(EventKind.STANCE_END, last, FEET[foot], last))
            if walk.absences.of[foot] is not Presence.MISSING:
                walk.absences.gone(foot, last, standing=standing)
                walk.absences.back(foot, until)
        walk.space.bridge(gap_s)
        walk.carriage.interrupted()
        walk.roll_back.forget()
        walk.watch()
        return [*found, Event(EventKind.BRIDGED, last, "both", until)]
