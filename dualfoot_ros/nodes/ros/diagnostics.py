"""What a node says about itself on /diagnostics."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from . import qos

OK = DiagnosticStatus.OK
WARN = DiagnosticStatus.WARN
ERROR = DiagnosticStatus.ERROR
OVER_S = 10.0


@dataclass
class Status:
    """One report: the worst that was found decides level and message."""

    values: dict[str, Any] = field(default_factory=dict)
    level: bytes = OK
    message: str = "ok"
    logged: dict[str, tuple[bytes, str]] = field(default_factory=dict)

    def note(self, level: bytes, message: str, kind: str = "") -> None:
        """Add a finding; the first of the worst level is the message.

        One with a ``kind`` is also logged, once when findings of that kind begin.
        """
        if level > self.level:
            self.level, self.message = level, message
        if kind and level > self.logged.get(kind, (OK, ""))[0]:
            self.logged[kind] = level, message


class Reporter:
    """Publishes what ``collect`` fills in, periodically by the wall clock."""

    def __init__(self, node: Node, period_s: float, collect: Callable[[Status], None]) -> None:
        self._node, self._collect = node, collect
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", qos.result(10))
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(period_s, self.report, clock=steady)
        self._beginnings = Beginnings()

    def report(self) -> None:
        """Publish one report now."""
        status = Status()
        self._collect(status)
        for sentence in self._beginnings.among(status.logged, time.monotonic()):
            self._node.get_logger().warning(sentence)
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        name = self._node.get_fully_qualified_name().lstrip("/")
        message.status = [to_message(name, status)]
        self._publisher.publish(message)


class Beginnings:
    """Picks the findings that were not there before, or have become worse.

    One that comes and goes is over only when it has stayed away for ``OVER_S``.
    """

    def __init__(self) -> None:
        self._known: dict[str, tuple[bytes, float]] = {}  # level, when it was last there

    def among(self, found: Mapping[str, tuple[bytes, str]], now_s: float) -> list[str]:
        """Return the sentences of those findings, by kind, that begin."""
        self._known = {k: v for k, v in self._known.items() if now_s - v[1] < OVER_S}
        begun = []
        for kind, (level, sentence) in found.items():
            before = self._known.get(kind, (OK, now_s))[0]
            if level > before:
                begun.append(sentence)
            self._known[kind] = max(level, before), now_s
        return begun


def to_message(name: str, status: Status) -> DiagnosticStatus:
    """Return a report as a message."""
    return DiagnosticStatus(
        level=status.level, name=name, message=status.message, values=key_values(status.values)
    )


def key_values(values: Mapping[str, Any]) -> list[KeyValue]:
    """Return named values as a message has them; numbers to a readable precision."""
    return [KeyValue(key=key, value=_text(value)) for key, value in values.items()]


class Rates:
    """Rates of counters between two looks at them."""

    def __init__(self) -> None:
        self._before: dict[str, int] = {}
        self._at = time.monotonic()

    def since_last(self, counters: Mapping[str, int]) -> dict[str, float]:
        """Return the increase of every counter per second of wall time."""
        now = time.monotonic()
        passed = max(1e-3, now - self._at)
        rates = {k: (n - self._before.get(k, 0)) / passed for k, n in counters.items()}
        self._before, self._at = dict(counters), now
        return rates


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
