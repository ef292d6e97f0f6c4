"""Reports of a node on /diagnostics."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from ...inspection import Finding, Key
from ...settings import ReportConfig
from . import qos
from .declared_parameters import group
from .status import Status

OVER_S = 10.0


class Reporter:
    """Publisher of what ``collect`` fills in, periodically by the wall clock."""

    def __init__(
        self, node: Node, values: Mapping[str, Any], collect: Callable[[Status], None]
    ) -> None:
        """Report with the period that the parameters ``values`` of ``node`` give."""
        self._node, self._collect = node, collect
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", qos.result(10))
        period_s = group(ReportConfig, values, "reports.").period
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(period_s, self.report, clock=steady)
        self._memory = FindingMemory()

    def report(self) -> None:
        """Publish one report now; log the findings that begin, and those that are over."""
        status = Status()
        self._collect(status)
        changes = self._memory.update(status.findings, time.monotonic())
        for finding in changes.begun:
            self._node.get_logger().warning(finding.sentence)
        for finding in changes.over:
            self._node.get_logger().info(f"over: {finding.text}")
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        name = self._node.get_fully_qualified_name().lstrip("/")
        message.status = [to_message(name, status)]
        self._publisher.publish(message)


class Changes(NamedTuple):
    """Findings to log: those that were not there before or have become worse, and those over."""

    begun: list[Finding]
    over: list[Finding]


class FindingMemory:
    """Memory of the findings of kinds to be logged once.

    A finding that comes and goes is over only when it has stayed away for ``OVER_S``.
    """

    def __init__(self) -> None:
        self._known: dict[Key, tuple[Finding, float]] = {}  # at its worst; when it was last there

    def update(self, findings: Iterable[Finding], now_s: float) -> Changes:
        """Take the findings of a report; return what is to be logged."""
        logged = [finding for finding in findings if finding.kind.logged_once]
        begun, there = [], {finding.key for finding in logged}
        over = [
            found
            for key, (found, last_s) in self._known.items()
            if key not in there and now_s - last_s >= OVER_S
        ]
        for finding in over:
            del self._known[finding.key]
        for finding in logged:
            known, _ = self._known.get(finding.key, (None, now_s))
            if known is None or finding.severity.rank > known.severity.rank:
                begun.append(finding)
                known = finding
            self._known[finding.key] = known, now_s
        return Changes(begun, [finding for finding in over if not finding.kind.momentary])


class Rates:
    """Rates of counters between two reports."""

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


def to_message(name: str, status: Status) -> DiagnosticStatus:
    """Return a status as a message."""
    return DiagnosticStatus(
        level=status.level, name=name, message=status.message, values=key_values(status.values)
    )


def key_values(values: Mapping[str, Any]) -> list[KeyValue]:
    """Return named values as a message has them; numbers to a readable precision."""
    return [KeyValue(key=key, value=_format(value)) for key, value in values.items()]


def _format(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
