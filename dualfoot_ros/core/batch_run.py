"""A whole recording at once: the bits of pair by pair, in long stretches of the kernel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .kernel import layout as lay
from .pair_stream import PairStream
from .results.events import Event, EventKind
from .results.rows import turn_rows
from .results.update import Update
from .samples.pair_gate import next_irregular, regular_samples
from .samples.series import FloatArray, ImuPair, IntArray
from .session import Session


class BatchRun:
    """The rows and events that a recording gives, as far as it has been run."""

    def __init__(self, stamps: IntArray, values: FloatArray) -> None:
        """Prepare to run pairs with stamps (N,) ns and values (N, 12)."""
        count = len(stamps)
        self._stamps, self._values = stamps, values
        self._dts = np.diff(stamps, prepend=stamps[:1]) * 1e-9
        self._out = np.zeros((count, lay.OUT))
        self._kept = np.zeros(count, dtype=bool)
        self._stops: IntArray | None = None
        self._taken: list[int] = []
        self.events: list[Event] = []

    def run(self, stream: PairStream) -> tuple[IntArray, FloatArray]:
        """Feed everything to ``stream``; return the stamps (M,) and rows (M, OUT) it gave."""
        k, count = 0, len(self._stamps)
        while k < count:
            session = stream.walking
            stop = k if session is None else self._next_stop(session, k)
            if session is not None and stop > k:
                self._run_stretch(stream, session, k, stop)
                k = stop
            else:
                self._add(stream, k)
                k += 1
        if self._taken:
            late = stream.start_late(int(self._stamps[self._taken[-1]]))
            if late is not None:
                self._keep(late)
        return self._rows()

    def _next_stop(self, session: Session, k: int) -> int:
        """Return the first sample from ``k`` on that is no regular one of ``session``."""
        if self._stops is None:
            longest_ns = session.holes.longest_ns
            self._stops = next_irregular(regular_samples(self._stamps, self._values, longest_ns))
        return int(self._stops[k])

    def _run_stretch(self, stream: PairStream, session: Session, start: int, stop: int) -> None:
        out = self._out
        steps = session.steps(self._stamps, self._dts, self._values, (start, stop), out)
        for row, found in steps:
            self._note(row, found)
        self._kept[start:stop] = stream.went_on(out[start:stop], int(self._stamps[stop - 1]))

    def _add(self, stream: PairStream, k: int) -> None:
        update = stream.add(ImuPair(int(self._stamps[k]), self._values[k]))
        if update.refused is None:
            self._taken.append(k)
        if any(event.kind is EventKind.RESET for event in update.announced):
            self._stops = None
            self._kept[:k], self._taken = False, self._taken[-1:]
            self.events.clear()
        self._keep(update)

    def _keep(self, update: Update) -> None:
        """Keep an update, and those before it, in the rows of the pairs taken last."""
        updates = (*update.earlier, update)
        for each, row in zip(updates, self._taken[-len(updates) :], strict=False):
            if each.row is not None:
                self._out[row], self._kept[row] = each.row, True
            self._note(row, each.announced)

    def _note(self, row: int, found: Sequence[Event]) -> None:
        """Keep the events of a row; a heading turns the rows before it."""
        for event in found:
            if event.kind is EventKind.HEADING:
                turn_rows(self._out[:row], event)
        self.events.extend(found)

    def _rows(self) -> tuple[IntArray, FloatArray]:
        """Return what is kept, without a copy where that is all from some row on."""
        kept = self._kept
        first = int(np.argmax(kept)) if kept.any() else len(kept)
        if kept[first:].all():
            return self._stamps[first:], self._out[first:]
        return self._stamps[kept], self._out[kept]
