"""Plausibility checks of a sensor's samples: rate, range, clipping, axes that are stuck."""

from __future__ import annotations

import math
from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from ..core import Parameters, Refusal, parameter
from .sample import Sample

AXES = tuple(f"{name} {axis}" for name in ("specific force", "angular rate") for axis in "xyz")
WINDOW = 256  # intervals from which the rate is taken
AT_THE_END = 0.995  # of the range
BEYOND = 1.5  # times the range: no sensor reads that, the bytes were damaged
NS = 1_000_000_000


@dataclass(frozen=True)
class CheckConfig(Parameters):
    """Expected properties of a sensor; 0 where one is not known."""

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


class SensorFault(StrEnum):
    """Faults of a sensor that its samples show."""

    STUCK_SENSOR = "stuck_sensor"
    STUCK_AXIS = "stuck_axis"
    WRONG_RATE = "wrong_rate"
    CLIPPED_FORCE = "clipped_force"
    CLIPPED_RATE = "clipped_rate"


class SensorFinding(NamedTuple):
    """A fault that was found: its kind for programs, a text for people."""

    kind: SensorFault
    text: str

    def __str__(self) -> str:
        return self.text


class SensorCheck:
    """Checks of every sample of one sensor.

    ``counters`` holds ``seen``, ``clipped_force``, ``clipped_rate`` (samples at the end of the
    range) and ``out_of_range`` (samples refused, far beyond it).
    """

    def __init__(self, config: CheckConfig | None = None) -> None:
        """Start with no sample seen."""
        self.config = config or CheckConfig()
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
        if _is_beyond(force, self.config.force_range) or _is_beyond(rate, self.config.rate_range):
            self.counters[Refusal.OUT_OF_RANGE] += 1
            return False
        self.counters[SensorFault.CLIPPED_FORCE] += _is_clipped(force, self.config.force_range)
        self.counters[SensorFault.CLIPPED_RATE] += _is_clipped(rate, self.config.rate_range)
        self._follow_runs((*sample.specific_force, *sample.angular_rate))
        return True

    def interrupt(self) -> None:
        """Mark that samples are missing here, so that the interval to the next gives no rate."""
        self._last_time = None

    @property
    def rate_hz(self) -> float:
        """Samples a second, from the median interval of the device's own clock; nan at first."""
        positive = sorted(step for step in self._intervals if step > 0)
        return NS / positive[len(positive) // 2] if positive else math.nan

    @property
    def stuck(self) -> tuple[str, ...]:
        """Names of the axes that read the same all the time; all six for a frozen sensor."""
        if self._is_frozen():
            return AXES
        limit = self.config.stuck_axis_after
        return tuple(name for name, run in zip(AXES, self._runs, strict=True) if run >= limit)

    @property
    def findings(self) -> list[SensorFinding]:
        """Faults of the sensor, each with a text; empty when there are none."""
        return [*self._check_stuck(), *self._check_rate(), *self._check_clipping()]

    def _check_stuck(self) -> Iterator[SensorFinding]:
        if self._is_frozen():
            text = f"the sensor is stuck: {min(self._runs)} equal samples in a row"
            yield SensorFinding(SensorFault.STUCK_SENSOR, text)
        elif self.stuck:
            yield SensorFinding(
                SensorFault.STUCK_AXIS, f"an axis is stuck: {', '.join(self.stuck)}"
            )

    def _check_rate(self) -> Iterator[SensorFinding]:
        expected = self.config.rate
        if not expected or len(self._intervals) < WINDOW // 4:
            return
        if abs(self.rate_hz - expected) > self.config.rate_tolerance * expected:
            text = (
                f"the sensor sends {self.rate_hz:.1f} samples a second where {expected:g} are "
                "expected"
            )
            yield SensorFinding(SensorFault.WRONG_RATE, text)

    def _check_clipping(self) -> Iterator[SensorFinding]:
        sensors = {
            SensorFault.CLIPPED_FORCE: "accelerometer",
            SensorFault.CLIPPED_RATE: "gyroscope",
        }
        for fault, name in sensors.items():
            if count := self.counters[fault]:
                text = (
                    f"the {name} was at the end of its range in {count} of "
                    f"{self.counters['seen']} samples"
                )
                yield SensorFinding(fault, text)

    def _is_frozen(self) -> bool:
        return min(self._runs) >= self.config.stuck_after

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


def _is_clipped(value: float, limit: float) -> bool:
    return 0.0 < AT_THE_END * limit <= value


def _is_beyond(value: float, limit: float) -> bool:
    return 0.0 < BEYOND * limit < value
