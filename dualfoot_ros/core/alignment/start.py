"""The start of a track: from the best standstill that comes, and from what is there if none does.

Two seconds of both feet as still as a person can stand start it at once.  A shorter or restless
stand is kept while a better one may come; ``alignment.patience`` after it the track starts from
it all the same, and the pairs since are run first.  Where nobody ever stands, the first stances of
the walk give the level, and the gyro bias is known as far as sensors of the kind are alike.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterator, Mapping
from contextlib import closing
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from ..config import TrackerConfig
from ..results.events import FEET
from ..samples.series import FloatArray, IntArray
from .first_stance import FirstStances
from .foot_stand import UNKNOWN_BIAS_STD, FootStandstill, absent_foot
from .foot_watch import FootWatch
from .prior import BiasPrior
from .sampling_rate import SamplingRate

ABSENT_S = 2.0  # without samples, after which a start does without a foot
UNKNOWN_BIAS = BiasPrior(np.zeros(3), UNKNOWN_BIAS_STD)
Pair = tuple[int, FloatArray]
Standstills = tuple[FootStandstill, FootStandstill]


class StartKind(StrEnum):
    """What a track starts from."""

    STAND = "stand"
    RESTLESS_STAND = "restless_stand"
    FIRST_STANCE = "first_stance"


class Start(NamedTuple):
    """What a track starts from.

    Attributes
    ----------
    feet : what is known of the left and the right foot
    rate_hz : sampling rate
    waiting : pairs since the stand, the newest included, that are to be run first
    """

    kind: StartKind
    feet: Standstills
    rate_hz: float
    waiting: tuple[Pair, ...] = ()


def worst_std(*feet: FootStandstill) -> float:
    """Return the largest deviation of a gyro bias of the feet that are there, rad/s."""
    return max(foot.rate_std for foot in feet if not foot.absent)


class Alignment:
    """Collects pairs until a track can start; afterwards refines what a stand tells."""

    def __init__(
        self, config: TrackerConfig, priors: Mapping[str, BiasPrior] | None = None
    ) -> None:
        """Start with no pair; ``priors`` are gyro biases that are known by foot."""
        self._config, self._priors = config, dict(priors or {})
        self.rate = SamplingRate()
        self._watches = tuple(FootWatch(config) for _ in FEET)
        self._first_stances = FirstStances(config)
        self._waiting: deque[Pair] = deque()
        self._candidate: Standstills | None = None
        self._without_stand: Standstills | None = None
        self._since_ns: int | None = None  # of the first candidate, or of the first pair
        self._levelled = 0
        self._first_ns: int | None = None

    @property
    def complaint(self) -> str | None:
        """Why the feet do not stand, if they do not."""
        for foot, watch in zip(FEET, self._watches, strict=True):
            if watch.complaint is not None:
                return f"{foot} foot: {watch.complaint}"
        return None

    @property
    def restarts(self) -> int:
        """Number of stands that motion has ended."""
        return max(watch.restarts for watch in self._watches)

    def add(self, stamp_ns: int, values: FloatArray) -> Start | None:
        """Take a pair (12,); return the start when there is one."""
        values = values.copy()
        self.rate.add(stamp_ns)
        self._waiting.append((stamp_ns, values))
        if self._since_ns is None:
            self._since_ns = self._first_ns = stamp_ns
        if self._candidate is None and self._without_stand is None:
            self._look_for_stances(stamp_ns, values)
        if self._look(stamp_ns, values):
            start = self._start_of_stand(stamp_ns)
            if start is not None:
                return start
        waited = stamp_ns - self._since_ns >= self._config.alignment.patience * 1e9
        return self.finish() if waited and not self._awaits_foot(stamp_ns) else None

    def _start_of_stand(self, stamp_ns: int) -> Start | None:
        """Look at the stand when a window has ended; return the start when it is long enough."""
        self._consider(stamp_ns)
        there = [w.quiet_s for w in self._watches if not self._absent(w, stamp_ns)]
        if there and min(there) >= self._config.alignment.duration:
            return self._start(StartKind.STAND, self._candidate)
        return None

    def finish(self) -> Start | None:
        """Return a start from what is there, when no more pairs will come."""
        if self._candidate is not None:
            return self._start(StartKind.RESTLESS_STAND, self._candidate)
        return self._start(StartKind.FIRST_STANCE, self._without_stand)

    def refine(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take one more pair of a stand; return True when a window's length more is known."""
        for watch in self._watches:
            watch.refining = True
        self._look(stamp_ns, values)
        return self._is_longer()

    def refine_all(self, stamps: IntArray, values: FloatArray) -> Iterator[int]:
        """Take pairs (N, 12) of a stand as `refine` does; yield those that it returns True for."""
        if len(stamps) == 0:
            return
        for watch in self._watches:
            watch.refining = True
        for row in self._windows_of(stamps, values):
            if self._is_longer():
                yield row

    def _windows_of(self, stamps: IntArray, values: FloatArray) -> Generator[int, None, None]:
        """Take the windows of both feet in pairs (N, 12); yield the pairs with which they end.

        All pairs up to that one are taken, or all of them at the end.
        """
        parts = [values[:, :6], values[:, 6:]]
        aheads = [w.look_ahead(stamps, p) for w, p in zip(self._watches, parts, strict=True)]
        taken = 0
        try:
            for row in sorted({row for ahead in aheads for row in ahead.windows}):
                taken = row + 1
                for watch, ahead in zip(self._watches, aheads, strict=True):
                    watch.seen_ns = int(stamps[row])
                    for take, window in ahead.windows.get(row, ()):
                        take(window)
                yield row
            taken = len(stamps)
        finally:
            for watch, ahead in zip(self._watches, aheads, strict=True):
                watch.take_all(ahead, stamps, taken)

    @property
    def takes_many(self) -> bool:
        """Whether only windows matter of the pairs that follow, as `add_all` takes them."""
        seen = all(watch.seen_ns is not None for watch in self._watches)
        return seen and not (self._candidate is None and self._without_stand is None)

    def add_all(self, stamps: IntArray, values: FloatArray) -> tuple[int, Start | None]:
        """Take pairs (N, 12) as `add` does, no hole between them and both feet there.

        Return how many were taken, none that could end the patience, and the start when there is
        one: that of the last one taken.
        """
        assert self._since_ns is not None
        patience_ns = self._config.alignment.patience * 1e9
        count = int(np.searchsorted(stamps - self._since_ns, patience_ns))
        stamps, values = stamps[:count], values[:count]
        begin, start = 0, None
        with closing(self._windows_of(stamps, values)) as ended:
            for row in ended:
                self._keep(stamps[begin : row + 1], values[begin : row + 1])
                begin = row + 1
                start = self._start_of_stand(int(stamps[row]))
                if start is not None:
                    return begin, start
        self._keep(stamps[begin:], values[begin:])
        return count, None

    def _keep(self, stamps: IntArray, values: FloatArray) -> None:
        """Keep pairs (N, 12) that wait for a start."""
        for pair in zip(stamps.tolist(), values, strict=True):
            self.rate.add(pair[0])
            self._waiting.append(pair)

    def _is_longer(self) -> bool:
        """Return whether the stand has grown by a window's length since it was last asked."""
        length = self._windows()
        more, self._levelled = length > self._levelled, length
        return more

    def _windows(self) -> int:
        """Return how many windows the stand of both feet is long."""
        shortest_s = min(watch.stand.seconds for watch in self._watches)
        return int(shortest_s / self._config.alignment.window)

    def _look(self, stamp_ns: int, values: FloatArray) -> bool:
        """Take a pair; return whether a window of either foot ended with it."""
        awaited = self._awaits_foot(stamp_ns)
        parts = values[:6].copy(), values[6:].copy()
        ended = [w.add(stamp_ns, part) for w, part in zip(self._watches, parts, strict=True)]
        if awaited and all(watch.seen_ns is not None for watch in self._watches):
            self._candidate, self._first_stances = None, FirstStances(self._config)
        return any(ended)

    def _look_for_stances(self, stamp_ns: int, values: FloatArray) -> None:
        """Take a pair; keep the first stances, of both feet or of the one that is alone."""
        absent = [self._absent(watch, stamp_ns) for watch in self._watches]
        self._without_stand = self._first_stances.add(stamp_ns, values, absent)
        if self._without_stand is not None:
            self._waiting.clear()

    def _awaits_foot(self, stamp_ns: int) -> bool:
        """Return whether the samples of a foot may just not have begun."""
        return any(w.seen_ns is None and not self._absent(w, stamp_ns) for w in self._watches)

    def _absent(self, watch: FootWatch, stamp_ns: int) -> bool:
        """Return whether a foot has had no sample for so long that the other one starts alone."""
        since_ns = self._first_ns if watch.seen_ns is None else watch.seen_ns
        return since_ns is not None and stamp_ns - since_ns >= ABSENT_S * 1e9

    def _standstill(self, watch: FootWatch, stamp_ns: int) -> FootStandstill | None:
        if watch.seen_ns is None or self._absent(watch, stamp_ns):
            return absent_foot(self._config.gravity, stamp_ns)
        return watch.standstill

    def _consider(self, stamp_ns: int) -> None:
        """Keep what the feet stand on now, unless something better is kept."""
        left, right = (self._standstill(watch, stamp_ns) for watch in self._watches)
        if left is None or right is None or (left.absent and right.absent):
            return
        kept = self._candidate
        if kept is None:
            self._since_ns = stamp_ns
        elif worst_std(left, right) > worst_std(*kept):
            since_ns = stamp_ns - max(foot.end_ns for foot in kept)
            if since_ns > self._config.alignment.window * 1e9:
                return
        self._candidate = left, right
        self._waiting.clear()

    def result(self) -> Standstills:
        """Return what the stand tells, with what was known before it."""
        left, right = (watch.stand.result() for watch in self._watches)
        return self._combined((left, right))

    def _combined(self, feet: Standstills) -> Standstills:
        """Return the standstills with the priors; both biases have the larger uncertainty.

        The scatter of a stand is a bad weight between the feet: the one that happened to be
        stiller would draw the other to its heading.
        """
        known = []
        for name, foot in zip(FEET, feet, strict=True):
            prior = self._priors.get(name, UNKNOWN_BIAS)
            known.append(prior.combined(foot.angular_rate, foot.rate_std))
        largest = max(std for (_, std), foot in zip(known, feet, strict=True) if not foot.absent)
        left, right = (f.with_bias(b, largest) for f, (b, _) in zip(feet, known, strict=True))
        return left, right

    def _start(self, kind: StartKind, feet: Standstills | None) -> Start | None:
        rate_hz = self.rate.hz
        if rate_hz is None or feet is None:
            return None
        self._levelled = self._windows()
        return Start(kind, self._combined(feet), rate_hz, tuple(self._waiting))
