"""How a foot turns outward and back in each swing, learnt, so that it is not taken for a turn.

The mean of both feet's headings follows a corner, but it also swings by several degrees with every
step of a straight walk.  That part repeats itself from stride to stride.
"""

from __future__ import annotations

import math

import numpy as np

BINS = 20  # of the phase of a swing
FORGET = 0.15  # weight of the newest swing
STRAIGHT = math.radians(15.0)  # a swing that turns by less teaches the pattern
LONGEST_S = 1.2  # of a swing in walking
SHORTEST_S = 0.2


class SwingPattern:
    """The repeated turn of one foot against the phase of its swing."""

    def __init__(self) -> None:
        """Know nothing: the pattern is zero."""
        self._turn = np.zeros(BINS)
        self._phases = (np.arange(BINS) + 0.5) / BINS
        self._duration_s = 0.6
        self._learnt = 0
        self._swing: list[tuple[float, float]] = []  # time (s) and heading (rad) since it began

    def add(self, time_s: float, heading: float, stance: bool) -> float:
        """Take the heading (rad, not wrapped) of an epoch; return how much of it is pattern."""
        if stance:
            if self._swing:
                self._learn(time_s, heading)
            self._swing.clear()
            return 0.0
        self._swing.append((time_s, heading))
        phase = (time_s - self._swing[0][0]) / self._duration_s
        return float(np.interp(phase, self._phases, self._turn)) if phase < 1.0 else 0.0

    def _learn(self, time_s: float, heading: float) -> None:
        """Learn from the swing that has ended now, unless it turned or was none of walking."""
        begin_s, begin = self._swing[0]
        duration_s, turned = time_s - begin_s, heading - begin
        if not SHORTEST_S < duration_s < LONGEST_S or abs(turned) > STRAIGHT:
            return
        times, headings = np.array(self._swing).T
        phase = (times - begin_s) / duration_s
        excess = headings - begin - turned * phase * phase * (3.0 - 2.0 * phase)
        self._learnt += 1
        weight = max(FORGET, 1.0 / self._learnt)
        self._turn += weight * (np.interp(self._phases, phase, excess) - self._turn)
        self._duration_s += weight * (duration_s - self._duration_s)
