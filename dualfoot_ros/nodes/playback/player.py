"""Player of recorded samples: in time, or as fast as the listeners follow."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ...core import FEET, FieldSeries, FloatArray, ImuSeries, PressureSeries
from ...settings import PlayConfig

Series = ImuSeries | PressureSeries | FieldSeries
GATE_POLL = 0.005  # s; a gate closes with much more under way than a listener takes in it
READY_POLL = 0.01  # s
DISCOVERY_S = 0.5  # a subscriber that is there may take 0.1 s more to find the publisher
LONGEST_NAP = 0.1  # s, so that a stop takes effect soon


class Sample(NamedTuple):
    """One recorded sample; ``due_ns`` is when it was recorded, never earlier than those before.

    ``foot`` is "left" or "right", or the topic of a sensor that is not on one foot.
    """

    due_ns: int
    foot: str
    stamp_ns: int
    values: FloatArray


def in_order(series: Mapping[str, Series]) -> Iterator[Sample]:
    """Yield the samples of all sensors in the order in which they were recorded."""
    tables = {foot: _to_table(samples) for foot, samples in series.items() if len(samples)}
    due = {f: np.maximum.accumulate(series[f].stamp_ns).tolist() for f in tables}
    feet = sorted(tables, key=lambda foot: (foot not in FEET, foot))
    keys = np.concatenate([np.asarray(due[foot]) for foot in feet])
    which = np.concatenate([np.full(len(due[foot]), k) for k, foot in enumerate(feet)])
    rows = np.concatenate([np.arange(len(due[foot])) for foot in feet])
    for i in np.argsort(keys, kind="stable").tolist():
        foot, row = feet[which[i]], int(rows[i])
        yield Sample(due[foot][row], foot, int(series[foot].stamp_ns[row]), tables[foot][row])


class Player:
    """Thread that hands every sample to ``publish`` when it is due.

    ``alive`` returns whether ROS can still publish (a signal can end it at any time), ``ready``
    whether the first sample may be played and ``gate`` whether the next one may: with a gate the
    speed is that of its owner, and ``play.rate`` has no meaning.  ``finished`` is called once at
    the end, from the thread, unless the player was stopped.
    """

    def __init__(
        self,
        samples: Callable[[], Iterator[Sample]],
        publish: Callable[[Sample], None],
        play: PlayConfig,
        *,
        alive: Callable[[], bool] = lambda: True,
        ready: Callable[[], bool] = lambda: True,
        gate: Callable[[], bool] | None = None,
        finished: Callable[[], None] = lambda: None,
    ) -> None:
        self.played = 0
        self._samples, self._publish, self._play = samples, publish, play
        self._alive, self._ready, self._gate, self._finished = alive, ready, gate, finished
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="player", daemon=True)

    def start(self) -> None:
        """Begin to play."""
        self._thread.start()

    def stop(self) -> None:
        """Stop playing and wait until nothing is published any more."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join()

    def join(self, timeout_s: float) -> bool:
        """Wait for the end; return whether it came within ``timeout_s``."""
        self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def _run(self) -> None:
        try:
            self._play_all()
        except Exception:
            if self._alive():
                raise

    def _play_all(self) -> None:
        wait_to_begin(self._play, self._ready, self._stop)
        self._play_once()
        while self._play.loop and not self._stop.is_set():
            self._play_once()
        if not self._stop.is_set():
            self._finished()

    def _play_once(self) -> None:
        start: tuple[int, float] | None = None
        for sample in self._samples():
            if start is None:
                start = (sample.due_ns, time.monotonic())
            self._wait_until_due(sample, *start)
            if self._stop.is_set():
                return
            self._publish(sample)
            self.played += 1

    def _wait_until_due(self, sample: Sample, first_ns: int, begin_s: float) -> None:
        if self._gate is not None:
            while not self._gate() and not self._stop.wait(GATE_POLL):
                pass
            return
        due_s = begin_s + (sample.due_ns - first_ns) * 1e-9 / self._play.rate
        while (left_s := due_s - time.monotonic()) > 0.0:
            if self._stop.wait(min(left_s, LONGEST_NAP)):
                return


def wait_to_begin(play: PlayConfig, ready: Callable[[], bool], stop: threading.Event) -> None:
    """Wait until ``ready``, ``play.wait`` at most, and then ``play.delay``; not when stopped."""
    until = time.monotonic() + play.wait
    while not ready():
        if time.monotonic() >= until or stop.wait(READY_POLL):
            break
    else:
        stop.wait(min(play.wait, DISCOVERY_S))
    stop.wait(play.delay)


def _to_table(series: Series) -> FloatArray:
    if isinstance(series, FieldSeries):
        return series.tesla
    if isinstance(series, PressureSeries):
        return series.pressure[:, None]
    return np.hstack([series.specific_force, series.angular_rate])
