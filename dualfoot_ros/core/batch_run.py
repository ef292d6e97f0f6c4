"""A whole recording at once: the bits of pair by pair, in long stretches of the kernel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .pair_stream import PairStream
from .results.events import Event, EventKind
from .results.row_store import RowStore
from .results.trajectory import Trajectory
from .results.update import Update
from .samples.pair_gate import next_irregular, regular_samples
from .samples.pair_series import PairSeries
from .samples.series import BoolArray, FloatArray, ImuPair, ImuSeries, IntArray
from .session import Session

STRETCH = 1 << 12  # samples that are run at once: what is looked at of them stays in the cache
STANDING = 1 << 7  # the same of a stand, whose windows are looked at before it is known to end
AHEAD = 1 << 8  # samples that are looked up at once, to be run one by one


class BatchRun:
    """The rows and events that a recording gives, as far as it has been run."""

    def __init__(self, left: ImuSeries, right: ImuSeries, covariances: bool = True) -> None:
        """Prepare to run two series of equal stamps."""
        series = self._series = PairSeries.of(left, right)
        self._stamps, self._store = series.stamp_ns, RowStore(len(series), covariances)
        self._kept = np.zeros(len(series), dtype=bool)
        self._stops: IntArray | None = None
        self._taken: list[int] = []
        self._single: dict[int, FloatArray] = {}  # rows that came one by one, by their places
        self._ahead, self._ahead_from = np.empty((0, 12)), 0  # values of pairs, one by one
        self.events: list[Event] = []

    def run(self, stream: PairStream) -> None:
        """Feed everything to ``stream`` and keep what it gives."""
        k, count = 0, len(self._stamps)
        while k < count:
            session = stream.undisturbed
            stop = k if session is None else self._stop(session, k)
            if session is not None and stop > k:
                self._run_stretch(stream, session, k, stop)
                k = stop
            else:
                k += self._align(stream, k) or self._add(stream, k)
        if self._taken:
            late = stream.start_late(int(self._stamps[self._taken[-1]]))
            if late is not None:
                self._keep(late)

    def _stop(self, session: Session, k: int) -> int:
        """Return the end of the stretch that begins with sample ``k``."""
        longest = STRETCH if session.phase == "walking" else STANDING
        return min(self._next_stop(session, k), k + longest)

    def _next_stop(self, session: Session, k: int) -> int:
        """Return the first sample from ``k`` on that is no regular one of ``session``."""
        if self._stops is None:
            longest_ns = session.holes.longest_ns
            spans = [slice(at, at + STRETCH) for at in range(0, len(self._stamps), STRETCH)]
            good = np.concatenate([self._series.good(span) for span in spans])
            self._stops = next_irregular(regular_samples(self._stamps, good, longest_ns))
        return int(self._stops[k])

    def _values_from(self, k: int) -> FloatArray:
        """Return the values (K, 12) of pair ``k`` and of some after it."""
        if not 0 <= k - self._ahead_from < len(self._ahead):
            self._ahead, self._ahead_from = self._series.values(slice(k, k + AHEAD)), k
        return self._ahead[k - self._ahead_from :]

    def _run_stretch(self, stream: PairStream, session: Session, start: int, stop: int) -> None:
        series, span = self._series, slice(start, stop)
        self._put_single()
        for row, found in session.steps(series, (start, stop), self._store):
            self._note(row, found)
        numbers = self._store.written(span, series.present(span), session.heading_variances())
        self._kept[span] = numbers
        stream.went_on(stop - start, int(self._stamps[stop - 1]), numbers=numbers)

    def _align(self, stream: PairStream, k: int) -> int:
        """Look for a start from pair ``k`` on, many pairs at once; return how many were taken."""
        values = self._values_from(k)
        taken, update = stream.align_all(self._stamps[k : k + len(values)], values)
        self._taken.extend(range(k, k + taken))
        if update is not None:
            self._keep(update)
        return taken

    def _add(self, stream: PairStream, k: int) -> int:
        """Feed pair ``k`` alone; return 1, the number of pairs."""
        update = stream.add(ImuPair(int(self._stamps[k]), self._values_from(k)[0]))
        if update.refused is None:
            self._taken.append(k)
        if any(event.kind is EventKind.RESET for event in update.announced):
            self._stops = None
            self._kept[:k], self._taken = False, self._taken[-1:]
            self.events.clear()
        self._keep(update)
        return 1

    def _keep(self, update: Update) -> None:
        """Keep an update, and those before it, in the rows of the pairs taken last."""
        updates = (*update.earlier, update)
        for each, row in zip(updates, self._taken[-len(updates) :], strict=False):
            if each.row is not None:  # a copy: an update holds more than its row
                self._single[row], self._kept[row] = each.row.copy(), True
                if len(self._single) == STRETCH:
                    self._put_single()
            self._note(row, each.announced)

    def _note(self, row: int, found: Sequence[Event]) -> None:
        """Keep the events of a row; a heading turns the rows before it."""
        for event in found:
            if event.kind is EventKind.HEADING:
                self._put_single()
                self._store.turn(row, event)
        self.events.extend(found)

    def _put_single(self) -> None:
        if self._single:
            self._store.put(list(self._single), np.array(list(self._single.values())))
            self._single.clear()

    @property
    def is_empty(self) -> bool:
        """Whether no row is kept."""
        return not self._kept.any()

    def trajectory(self, counters: Mapping[str, int], method: str) -> Trajectory:
        """Return what is kept, without a copy where that is all from some row on."""
        first = int(np.argmax(self._kept))
        keep: BoolArray | slice = slice(first, len(self._kept))
        if not self._kept[keep].all():
            keep = self._kept
        self._put_single()
        events = tuple(self.events)
        return self._store.trajectory(self._stamps[keep], keep, events, counters, method)
