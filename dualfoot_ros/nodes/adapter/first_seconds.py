"""The first seconds of a sensor, said once: rate, units, gravity, format, clock, advice."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from ...core import FloatArray
from ...drivers import parse_uri
from ...inspection import advice_on, arrival_facts, describe_arrival
from ..inputs.stamper import Stamper
from .source_uri import DEVICE, Source, is_live

TOPIC = "topic"
HEADERS = "stamps in the headers", "headers without stamps"
DEVICES = "its own clock", "no clock of its own"
REPORT_AFTER = 4.5  # s
LEAST_SAMPLES = 20
MOST_SAMPLES = 10_000


class FirstSeconds:
    """Collects the first samples, before mounting and stamping, and logs what they are.

    ``said`` holds the lines that were logged; no sample is kept after that.
    """

    def __init__(
        self, node: Node, source: Source, stamper: Stamper, topic: Callable[[], str]
    ) -> None:
        """Report ``REPORT_AFTER`` seconds from now, or later when no samples have come.

        ``topic`` returns the name of the topic that is relayed.
        """
        self.said: list[str] = []
        self._node, self._source, self._stamper, self._topic = node, source, stamper, topic
        self._samples: list[tuple[int | None, int, FloatArray]] = []
        self._done = False
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(REPORT_AFTER, self.report, clock=steady)

    def add(self, time_ns: int | None, arrival_ns: int, values: FloatArray) -> None:
        """Take a sample (6,) in the units that are set, with its header's or device's time."""
        if not self._done and len(self._samples) < MOST_SAMPLES:
            self._samples.append((time_ns, arrival_ns, np.array(values)))

    def report(self) -> None:
        """Log once what the samples so far are, and what to change."""
        samples = list(self._samples)
        if self._done or len(samples) < LEAST_SAMPLES:
            return
        self._done = True
        self._timer.cancel()
        self._samples.clear()
        values = np.array([sample for _, _, sample in samples])
        times = [time for time, _, _ in samples if time is not None]
        has_time = len(times) == len(samples) and any(times)  # zeros are no stamps
        stamps = times if has_time else self._arrivals(samples)
        facts = arrival_facts(
            np.array(stamps, dtype=np.int64), values[:, :3], values[:, 3:], has_time
        )
        advice = advice_on(facts, units_known=self._source.kind == DEVICE)
        words = describe_arrival(facts, HEADERS if self._source.kind == TOPIC else DEVICES)
        line = f"receives {words}{self._describe_format()}{self._clock()}"
        self._say(line if advice else f"{line}; nothing to change", warn=False)
        for name, text in advice.items():
            self._say(f"{name}: {text}", warn=True)

    def _arrivals(self, samples: Sequence[tuple[int | None, int, FloatArray]]) -> list[int]:
        """Return the times of arrival; zeros for a file, whose pace says nothing."""
        told = self._source.kind == TOPIC or is_live(self._source)
        return [arrival if told else 0 for _, arrival, _ in samples]

    def _describe_format(self) -> str:
        if self._source.kind == TOPIC:
            return f"; from topic {self._topic()}"
        if self._source.kind != DEVICE:
            return f"; from {self._source.target}"
        return f"; format {parse_uri(self._source.target).format}"

    def _clock(self) -> str:
        if not is_live(self._source):
            return ""
        states = self._stamper.states.values()
        known = [f"clock {s.phase}, skew {s.skew_ppm:+.0f} ppm" for s in states]
        return f"; {known[0]}" if known else "; stamps are times of arrival"

    def _say(self, line: str, *, warn: bool) -> None:
        self.said.append(line)
        log = self._node.get_logger()
        if warn:
            log.warning(line)
        else:
            log.info(line)
