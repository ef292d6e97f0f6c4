"""Pairs with equal stamps from two streams, sample by sample.

The grid is either the stamps of one foot, whose samples then pass unchanged while the other foot
is interpolated (or held, ``between``) onto them (``rate`` 0: no rate has to be known or
estimated, a sensor clock that is off or drifts is followed, and streams that share their stamps
pass untouched), or it is uniform from the first common stamp on (``rate`` above 0: both feet are
interpolated).

A hole of a foot up to ``max_gap`` is filled; in the reference foot with stamps that divide it
evenly.  In a longer one, before a foot begins and after it ends the pairs are those of the living
foot, at its stamps, with NaN for the missing one.  A foot that is late is waited for until a pair
is ``max_delay`` old; then the other goes on alone, one sample late, until that foot is at most
half of ``max_delay`` behind again.

Times of arrival only tell whether a clock was set, so any interleaving whose lateness is below
``max_delay`` gives the same pairs, bit for bit those of
:func:`dualfoot_ros.timing.pairing.batch`; where a foot comes back after it was given up, if it is
late by less than a sample.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...core import FEET, FloatArray, ImuPair
from .clock_jumps import ClockJumps
from .grid import grid_of
from .pairing_config import AlignerConfig
from .sample_buffer import WAIT, BufferedSample, SampleBuffer
from .stream_gate import Gate, all_finite

OUTCOMES = (
    "pairs", "left_missing", "right_missing", "interpolated", "in_gap", "late", "outside",
    "restarts",
)  # fmt: skip
ABSENT = BufferedSample(None, "absent")
MISSING = np.full(6, np.nan)
PATIENCE = 5  # times restart_after, while the clock of one foot alone seems to be set


class Aligner:
    """Turn two streams of samples into pairs with equal stamps, with bounded memory and delay.

    ``counters`` holds for each foot ``left_accepted``, ``left_not_finite``, ``left_duplicate``,
    ``left_out_of_order``, ``left_gap`` and ``left_clock_set`` (see
    :class:`dualfoot_ros.timing.pairing.clock_jumps.ClockJumps`), and of the grid ``pairs``,
    ``left_missing`` (pairs without that foot), ``interpolated`` (pairs in which a foot was, or was
    held), ``in_gap`` (dropped, both feet have a hole there), ``late`` (samples that came when
    their pair had been given up), ``outside`` (dropped, the other foot begins or ends a moment
    earlier or later) and ``restarts``.  ``present`` tells of each foot whether it is there.
    """

    def __init__(
        self, config: AlignerConfig | None = None, feet: Sequence[str] = tuple(FEET)
    ) -> None:
        """Pair the samples of ``feet``; those of another one are not waited for or looked at."""
        self.config = config or AlignerConfig()
        self._feet = tuple(feet)
        self._gates = {foot: Gate(self.config) for foot in FEET}
        self._jumps = ClockJumps(self.config)
        self._outcomes = dict.fromkeys(OUTCOMES, 0)
        self.reset()

    @property
    def counters(self) -> dict[str, int]:
        """What became of every sample and of every stamp of the grid."""
        feet = {f"{f}_{k}": n for f in FEET for k, n in self._gates[f].counters.items()}
        jumps = {f"{foot}_clock_set": n for foot, n in self._jumps.jumps.items()}
        return feet | jumps | self._outcomes

    def shift_ns(self, foot: str) -> int:
        """Return what is added to the stamps of a foot, as its clock was set, ns."""
        return self._jumps.shift_ns[foot]

    @property
    def pairs_of_both(self) -> int:
        """How many pairs had a sample of each foot."""
        made = self._outcomes
        return made["pairs"] - made["left_missing"] - made["right_missing"]

    @property
    def clocks_set(self) -> int:
        """How often the clock of a foot was set, or the stamps of both went back."""
        return sum(self._jumps.jumps.values()) + self._outcomes["restarts"]

    def behind_ns(self, foot: str) -> int:
        """Return how much more than usual the newest stamp of a foot is behind the other's."""
        own, other = self._buffers[foot], self._buffers[_other(foot)]
        if other.first_ns is None:
            return 0
        if own.first_ns is None:
            return other.newest_ns - other.first_ns
        usual_ns = min(max(0, -self._jumps.usual_lead_ns(foot)), self.config.max_delay_ns)
        return max(0, other.newest_ns - own.newest_ns - usual_ns)

    def reset(self) -> None:
        """Forget all samples; the counters and what clocks were set by stay."""
        for gate in self._gates.values():
            gate.forget()
        self._buffers = {foot: SampleBuffer(self.config) for foot in FEET}
        self._grid = grid_of(self.config)
        self._given_up = {foot: foot not in self._feet for foot in FEET}
        self.present = dict.fromkeys(FEET, False)
        self._paired_ns: int | None = None

    def push(
        self, foot: str, stamp_ns: int, values: FloatArray, arrival_ns: int | None = None
    ) -> list[ImuPair]:
        """Take one sample and return the pairs that are complete with it.

        ``arrival_ns`` is when it came, by any clock; it only tells whether a clock was set, for
        which the order of the calls serves where it is not known.
        ``values`` (6,) is specific force (m/s^2) and angular rate (rad/s).  A sample that cannot
        be used is counted, never an exception.  A stream that goes on at an older time (see
        ``restart_after``) resets the aligner, and the stamps of the pairs go back with it, unless
        the time is that of the other foot.
        """
        if foot not in self._feet:
            return []
        stamp_ns = int(stamp_ns)
        sample = np.array(values, dtype=np.float64)
        is_set = self._jumps.is_set(foot, stamp_ns, arrival_ns)
        stamp_ns += self._jumps.shift_ns[foot]
        if is_set:
            self._follow(foot, stamp_ns)
        if not self._admit(foot, stamp_ns, all_finite(sample.tolist())):
            return []
        lost_ns = self._buffers[foot].append(stamp_ns, sample)
        self._outcomes["late"] += self._paired_ns is not None and stamp_ns <= self._paired_ns
        self._grid.admit(foot, stamp_ns, lost_ns)
        self._welcome(foot, stamp_ns)
        return list(self._complete())

    def finish(self) -> list[ImuPair]:
        """Return the pairs that still wait, at the end of the streams."""
        return list(self._complete(finished=True))

    def _admit(self, foot: str, stamp_ns: int, finite: bool) -> bool:
        gate = self._gates[foot]
        if gate.refusal(stamp_ns, finite) is None:
            return True
        patience = PATIENCE if self._jumps.suspects(foot) else 1
        if gate.backward < patience * self.config.restart_after:
            return False
        if self._is_in_line(foot, stamp_ns):
            self._begin_again(foot)
        else:
            self._outcomes["restarts"] += 1
            self.reset()
        return gate.refusal(stamp_ns, True) is None

    def _follow(self, foot: str, stamp_ns: int) -> None:
        """Go on after the clock of a foot was set; pairs far ahead of it are past."""
        if self._paired_ns is not None and self._paired_ns - stamp_ns > self.config.max_delay_ns:
            self._outcomes["restarts"] += 1
            self.reset()
        else:
            self._begin_again(foot)

    def _is_in_line(self, foot: str, stamp_ns: int) -> bool:
        """Return whether a stamp is near those of the other foot: one was in the future."""
        other = self._buffers[_other(foot)]
        near = abs(stamp_ns - other.newest_ns) <= self.config.max_delay_ns
        return other.first_ns is not None and near

    def _begin_again(self, foot: str) -> None:
        """Take the next sample of a foot as its first, while the other goes on."""
        self._gates[foot].forget()
        self._buffers[foot] = SampleBuffer(self.config)
        self._grid.forget(foot)

    def _welcome(self, foot: str, stamp_ns: int) -> None:
        """Wait again for a foot that is back in time."""
        behind_ns = self._buffers[_other(foot)].newest_ns - stamp_ns
        if self._given_up[foot] and 2 * behind_ns <= self.config.max_delay_ns:
            self._given_up[foot] = False

    def _complete(self, finished: bool = False) -> Iterator[ImuPair]:
        while (stamp_ns := self._grid.head(self._newest_ns(finished))) is not None:
            found = [self._at(foot, stamp_ns, finished) for foot in FEET]
            if any(f is WAIT for f in found) or (finished and stamp_ns > self._end_ns()):
                return
            outside = self._is_outside(found)
            for buffer in self._buffers.values():
                buffer.forget(stamp_ns)
            if outside or all(f.values is None for f in found):
                self._drop(stamp_ns, found, outside)
                continue
            self._count(found)
            self._grid.advance(stamp_ns + 1)
            self._paired_ns = stamp_ns
            values = [MISSING if f.values is None else f.values for f in found]
            yield ImuPair(stamp_ns, np.concatenate(values))

    def _at(self, foot: str, stamp_ns: int, finished: bool) -> BufferedSample:
        """Return the sample of a foot, WAIT, or ABSENT when it is not waited for."""
        buffer = self._buffers[foot]
        found = buffer.at(stamp_ns)
        if found is not WAIT or not (finished or self._goes_on_without(foot, stamp_ns)):
            return found
        found = buffer.at(stamp_ns, patient=False)
        return ABSENT if found is WAIT else found

    def _goes_on_without(self, foot: str, stamp_ns: int) -> bool:
        """Return whether the pair of ``stamp_ns`` is not to wait for a foot any longer."""
        other = self._buffers[_other(foot)]
        waited_ns = other.newest_ns - stamp_ns if other.first_ns is not None else 0
        if waited_ns > self.config.max_delay_ns:
            self._given_up[foot] = True
        alone = foot not in self._feet
        return alone or (self._given_up[foot] and waited_ns > self.config.tolerance_ns)

    def _is_outside(self, found: Sequence[BufferedSample]) -> bool:
        """Return whether a foot begins or ends a moment later or earlier than the other."""
        left, right = (self._buffers[foot] for foot in FEET)
        if left.first_ns is None or right.first_ns is None:
            return False
        if any(f.why == "outside" for f in found):
            return abs(left.first_ns - right.first_ns) <= self.config.max_gap_ns
        near = abs(left.newest_ns - right.newest_ns) <= self.config.max_gap_ns
        return near and any(f is ABSENT for f in found)

    def _count(self, found: Sequence[BufferedSample]) -> None:
        self._outcomes["pairs"] += 1
        self._outcomes["interpolated"] += any(f.why == "interpolated" for f in found)
        for foot, sample in zip(FEET, found, strict=True):
            self.present[foot] = sample.values is not None
            self._outcomes[f"{foot}_missing"] += sample.values is None

    def _drop(self, stamp_ns: int, found: Sequence[BufferedSample], outside: bool) -> None:
        next_ns = [f.next_ns for f in found if f.next_ns and not outside]
        until_ns = max(stamp_ns + 1, min(next_ns, default=0))
        self._outcomes["outside" if outside else "in_gap"] += self._grid.advance(until_ns)

    def _newest_ns(self, finished: bool) -> int:
        on = [b.newest_ns for b in self._buffers.values() if b.first_ns is not None]
        return max(on) + (2 * self.config.max_delay_ns if finished else 0) if on else 0

    def _end_ns(self) -> int:
        on = [b.newest_ns for b in self._buffers.values() if b.first_ns is not None]
        return max(on) + self.config.tolerance_ns


def _other(foot: str) -> str:
    return FEET[1 - FEET.index(foot)]
