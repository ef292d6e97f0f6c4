"""Pace of a recording: its samples handed on as fast as they were taken."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from ..sample import Sample

LONGEST_STEP_NS = 10_000_000_000  # a longer step of the device's clock is a restart


class Pacer:
    """Hands on each sample when it is due by the device's own clock.

    Samples without device time are handed on at once.  Their arrival is set to the moment they
    are handed on.
    """

    def __init__(
        self, speed: float, stopping: threading.Event, clock: Callable[[], int] = time.time_ns
    ) -> None:
        """Play ``speed`` times as fast as real time, until ``stopping`` is set."""
        self._speed = speed
        self._stopping = stopping
        self._clock = clock
        self._last: Sample | None = None
        self._due_s = time.monotonic()

    def deliver(self, samples: list[Sample], hand_on: Callable[[list[Sample]], None]) -> None:
        """Hand on each sample in its time."""
        for sample in samples:
            step_s = self._step_s(sample)
            self._due_s += step_s / self._speed
            if self._stopping.wait(max(0.0, self._due_s - time.monotonic())):
                return
            hand_on([sample._replace(arrival_ns=self._clock())])

    def _step_s(self, sample: Sample) -> float:
        """Return the time since the sample before, s; 0 at the first and after a restart."""
        last, self._last = self._last, sample
        if last is None:
            self._due_s = time.monotonic()
        if last is None or last.ticks is None or sample.ticks is None:
            return 0.0
        step_ns = (sample.ticks - last.ticks) % (1 << sample.tick_bits) * sample.tick_ns
        return step_ns * 1e-9 if step_ns <= LONGEST_STEP_NS else 0.0
