"""Even stamps, live, for samples whose stamps only tell when they arrived somewhere.

The number of a sample is taken as the time of a clock, which :class:`DeviceClock` follows below
the stamps as they come: jitter makes them late, never early.  A sample that was lost shows
afterwards, when even the fastest of the next ones come later by its interval.  It is the live
form of :func:`dualfoot_ros.timing.even_stamps`.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

import numpy as np

from ...core import TimingError
from ..offset.even_stamps import even_stamps
from .clock_config import DeviceClockConfig
from .device_clock import DeviceClock
from .state import ClockState

FIRST_NS = 2_000_000_000  # in which the interval of the samples is learnt
FIRST_SAMPLES = 100
MOST_SAMPLES = 10_000
INTERVAL_PPM, LARGEST_PPM = 3000.0, 40_000.0  # by which it is off then; usually, at most
SURE = 0.75  # of the interval by which even the fastest of some samples must be late
MOST = 30  # of these samples; where jitter is small, fewer are enough
DOUBT = 1e-6  # chance that so many are late and none was lost
USUAL = 300  # samples that tell how many are late by chance
RENEW = 50  # samples after which that is asked again
PACE = 0.5  # of their own, at which they must have come: after a stall all are late at first
APART_NS = 300_000_000  # beyond it the stream went on at another time: after a silence, or set
AGREEING = 10  # samples that must say so


class EvenClock:
    """Gives the samples of one sensor even stamps, from those that jitter.

    ``counters`` holds ``settling`` (samples withheld at first) and ``holes`` (samples that have
    been found to be missing).
    """

    def __init__(self, config: DeviceClockConfig | None = None) -> None:
        config = config or DeviceClockConfig()
        self._config = replace(config, skew_scale=INTERVAL_PPM, max_skew=LARGEST_PPM)
        self.counters = {"settling": 0, "holes": 0}
        self._first: deque[int] = deque(maxlen=MOST_SAMPLES)
        self._clock: DeviceClock | None = None
        self._interval_ns = 0.0
        self._number = 0
        self._shift_ns = 0  # by silences, and by clocks that were set
        self._late_ns: deque[int] = deque(maxlen=USUAL)
        self._times: deque[int] = deque(maxlen=MOST)
        self._needed, self._counted = MOST, 0

    def update(self, header_ns: int, arrival_ns: int) -> int | None:
        """Return the even stamp of the next sample, ns; None while settling.

        It is that of the header without its jitter, or of the arrival where the header is zero.
        """
        time_ns = int(header_ns or arrival_ns)
        return self._learn(time_ns) if self._clock is None else self._follow(self._clock, time_ns)

    def _learn(self, time_ns: int) -> int | None:
        """Collect the first samples; when there are enough, number them and follow them."""
        if self._first and time_ns < self._first[-1]:
            self._first.clear()
        self._first.append(time_ns)
        self.counters["settling"] += 1
        if len(self._first) < FIRST_SAMPLES or time_ns - self._first[0] < FIRST_NS:
            return None
        try:
            even = even_stamps("", np.array(self._first, dtype=np.int64))
        except TimingError:
            self._first.clear()
            return None
        self._interval_ns = even.interval_ns
        numbers = np.rint((even.stamp_ns - even.stamp_ns[0]) / even.interval_ns).astype(int)
        self._clock = DeviceClock(self._config)
        for number, each_ns in zip(numbers.tolist(), self._first, strict=True):
            self._clock.update(round(number * even.interval_ns), each_ns)
        self._number = int(numbers[-1])
        self._first.clear()
        return None

    def _follow(self, clock: DeviceClock, time_ns: int) -> int | None:
        self._number += 1
        stamp_ns = self._predict(clock)
        self._times.append(time_ns)
        self._late_ns.append(time_ns - stamp_ns)
        self._renew_needed()
        if abs(self._late_ns[-1]) > APART_NS and not self._goes_on_elsewhere():
            return stamp_ns
        self._skip_lost()
        found = clock.update(self._device_ns, time_ns - self._shift_ns)
        self.counters["settling"] += found is None
        return None if found is None else found + self._shift_ns

    def _predict(self, clock: DeviceClock) -> int:
        """Return the stamp of the newest number as the clock has it before its sample, ns."""
        translated_ns = clock.translate(self._device_ns)
        assert translated_ns is not None
        return translated_ns + self._shift_ns

    @property
    def _device_ns(self) -> int:
        return round(self._number * self._interval_ns)

    def _goes_on_elsewhere(self) -> bool:
        """Follow a stream that goes on at another time, when enough samples agree on it."""
        if len(self._late_ns) < AGREEING or not self._in_pace(AGREEING):
            return False
        newest = [self._late_ns[-k] for k in range(1, AGREEING + 1)]
        if not (min(newest) > APART_NS or max(newest) < -APART_NS):
            return False
        self._shift_ns += min(newest)
        self._late_ns.extend([each - min(newest) for each in newest])
        return True

    def _in_pace(self, count: int) -> bool:
        """Return whether the newest samples came about as fast as they were taken."""
        if len(self._times) < count:
            return False
        passed_ns = self._times[-1] - self._times[-count]
        return passed_ns > PACE * (count - 1) * self._interval_ns

    def _renew_needed(self) -> None:
        """Ask now and then how many samples in a row are hardly ever late by chance."""
        self._counted += 1
        if self._counted % RENEW or len(self._late_ns) < USUAL:
            return
        limit_ns = SURE * self._interval_ns
        late = sum(each > limit_ns for each in self._late_ns)
        chance = (late + 1) / (USUAL + 2)
        self._needed = max(2, min(MOST, math.ceil(math.log(DOUBT) / math.log(chance))))

    def _skip_lost(self) -> None:
        """Leave out the numbers of samples that were lost."""
        late_ns, count = self._late_ns, self._needed
        if len(late_ns) < count or not self._in_pace(count):
            return
        lost = int(min(late_ns[-k] for k in range(1, count + 1)) / self._interval_ns + 1.0 - SURE)
        if lost > 0:
            self.counters["holes"] += lost
            self._number += lost
            for k in range(1, count + 1):
                late_ns[-k] -= round(lost * self._interval_ns)

    @property
    def state(self) -> ClockState:
        """What is known of the numbering as a clock; its skew is against the first interval."""
        if self._clock is None:
            nan = float("nan")
            phase = "settling" if self._first else "empty"
            age_s = 1e-9 * (self._first[-1] - self._first[0]) if self._first else 0.0
            return ClockState(phase, age_s, 0, nan, nan, nan, nan, nan, 0)
        return replace(self._clock.state, interval_s=float("nan"))
