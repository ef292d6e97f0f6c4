"""Is what a sensor sends plausible?  Rate, range, clipping, axes that are stuck."""

from __future__ import annotations

import math
from collections import Counter, deque
from dataclasses import dataclass

from ..core import Parameters, parameter
from .sample import Sample

AXES = tuple(f"{what} {axis}" for what in ("specific force", "angular rate") for axis in "xyz")
WINDOW = 256  # intervals the rate is told from
AT_THE_END = 0.995  # of the range
BEYOND = 1.5  # times the range: no sensor reads that, the bytes were damaged
NS = 1_000_000_000


@dataclass(frozen=True)
class Checks(Parameters):
    """What is expected of a sensor; 0 where it is not known."""

    rate: float = parameter(0.0, "samples a second", unit="Hz", minimum=0.0, maximum=10000.0)
    rate_tolerance: float = parameter(
        0.05, "share of the rate it may be off", minimum=0.001, maximum=1.0
    )
    force_range: float = parameter(
        0.0, "range of the accelerometer", unit="m/s^2", minimum=0.0, maximum=10000.0
    )
    rate_range: float = parameter(
        0.0, "range of the gyroscope", unit="rad/s", minimum=0.0, maximum=1000.0
    )
    stuck_after: int = parameter(
        50, "equal samples in a row after which the sensor is stuck", minimum=2, maximum=100000
    )
    stuck_axis_after: int = parameter(
        1000, "equal readings of one axis in a row after which it is", minimum=2, maximum=1000000
    )


class SensorCheck:
    """Look at every sample of one sensor.

    ``counters`` holds ``seen``, ``clipped_force``, ``clipped_rate`` (samples at the end of the
    range) and ``out_of_range`` (samples refused, far beyond it).
    """

    def __init__(self, options: Checks | None = None) -> None:
        """Start with no sample seen."""
        self.options = options or Checks()
        self.counters: Counter[str] = Counter()
        self._runs = [0] * 6
        self._last: tuple[float, ...] | None = None
        self._last_time: tuple[int, int] | None = None
        self._intervals: deque[int] = deque(maxlen=WINDOW)

    def accept(self, sample: Sample) -> bool:
        """Take a sample; return False when it cannot be a reading of this sensor."""
        self.counters["seen"] += 1
        self._follow_time(sample)
        force = max(map(abs, sample.specific_force))
        rate = max(map(abs, sample.angular_rate))
        if _beyond(force, self.options.force_range) or _beyond(rate, self.options.rate_range):
            self.counters["out_of_range"] += 1
            return False
        self.counters["clipped_force"] += _clipped(force, self.options.force_range)
        self.counters["clipped_rate"] += _clipped(rate, self.options.rate_range)
        self._follow_runs((*sample.specific_force, *sample.angular_rate))
        return True

    def interrupt(self) -> None:
        """Say that samples are missing here, so that the interval to the next tells no rate."""
        self._last_time = None

    @property
    def rate_hz(self) -> float:
        """Samples a second, from the median interval of the device's own clock; nan at first."""
        positive = sorted(step for step in self._intervals if step > 0)
        return NS / positive[len(positive) // 2] if positive else math.nan

    @property
    def stuck(self) -> tuple[str, ...]:
        """Names of the axes that read the same all the time; all six for a frozen sensor."""
        if min(self._runs) >= self.options.stuck_after:
            return AXES
        limit = self.options.stuck_axis_after
        return tuple(name for name, run in zip(AXES, self._runs, strict=True) if run >= limit)

    @property
    def findings(self) -> list[str]:
        """What is wrong, in words; empty when nothing is."""
        found = []
        if self.stuck == AXES:
            found.append(f"the sensor is stuck: {min(self._runs)} equal samples in a row")
        elif self.stuck:
            found.append(f"an axis is stuck: {', '.join(self.stuck)}")
        if self._rate_is_off():
            found.append(
                f"it sends {self.rate_hz:.1f} samples a second where {self.options.rate:g} are "
                "expected"
            )
        for counter, what in (("clipped_force", "accelerometer"), ("clipped_rate", "gyroscope")):
            if self.counters[counter]:
                found.append(
                    f"the {what} was at the end of its range in {self.counters[counter]} of "
                    f"{self.counters['seen']} samples"
                )
        return found

    def _rate_is_off(self) -> bool:
        expected = self.options.rate
        if not expected or len(self._intervals) < WINDOW // 4:
            return False
        return abs(self.rate_hz - expected) > self.options.rate_tolerance * expected

    def _follow_runs(self, values: tuple[float, ...]) -> None:
        if self._last is not None:
            same = zip(self._runs, values, self._last, strict=True)
            self._runs = [run + 1 if now == before else 1 for run, now, before in same]
        else:
            self._runs = [1] * 6
        self._last = values

    def _follow_time(self, sample: Sample) -> None:
        """Collect intervals of the device's clock, or of the arrivals where it sends none."""
        if sample.ticks is None:
            time, modulus, unit = sample.arrival_ns, 1 << 64, 1
        else:
            time, modulus, unit = sample.ticks, 1 << sample.tick_bits, sample.tick_ns
        if self._last_time is not None and self._last_time[1] == modulus:
            step = (time - self._last_time[0]) % modulus * unit
            if step < NS:
                self._intervals.append(step)
        self._last_time = time, modulus


def _clipped(value: float, limit: float) -> bool:
    return 0.0 < AT_THE_END * limit <= value


def _beyond(value: float, limit: float) -> bool:
    return 0.0 < BEYOND * limit < value
