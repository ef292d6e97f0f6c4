"""What the nodes of one walk report on /diagnostics, read for people."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from ...core import FEET
from ..inputs.foot_states import FootState
from ..ros.status import OK

FUSION, SYNC = "fusion", "time_sync"
ADAPTERS = {foot: f"{foot}/imu_adapter" for foot in FEET}
NODES = (FUSION, SYNC, "replay", *ADAPTERS.values())
GONE_S = 5.0  # without a report: the node has ended, or does not come through
LEAST_S = 0.5  # between two counts that make a rate
RECEIVED = "received "
LOSSES = ("lost ", "dropped ")
"""On the way to a node, and in its queue, as it was too slow for them."""

Counts = dict[str, float | None]


@dataclass
class Report:
    """Newest report of a node: when it came, what it counts, and since when and what before.

    ``rates`` are the counts a second since the ``base``.
    """

    level: bytes
    message: str
    values: dict[str, str]
    at_s: float
    counts: Counts
    base: tuple[float, Counts]
    rates: dict[str, float] = field(default_factory=dict)


class NodeReports:
    """Newest report of each node in one namespace."""

    def __init__(self, namespace: str) -> None:
        """Take reports of the nodes in ``namespace`` (``/`` or ``/anna``), and of no other."""
        space = namespace.strip("/")
        self._prefix = f"{space}/" if space else ""
        self._reports: dict[str, Report] = {}

    def take(self, message: DiagnosticArray) -> None:
        """Take the reports of a message."""
        now_s = time.monotonic()
        for status in message.status:
            name = status.name.removeprefix(self._prefix)
            if status.name.startswith(self._prefix) and name in NODES:
                self._reports[name] = _read(status, self._reports.get(name), now_s)

    def known(self) -> dict[str, Report]:
        """Return the reports of the nodes that still report, by their names."""
        oldest_s = time.monotonic() - GONE_S
        return {name: report for name, report in self._reports.items() if report.at_s >= oldest_s}

    def warnings(self) -> list[dict[str, str]]:
        """Return what the nodes complain of: the node and its sentence."""
        reports = self.known()
        found = [
            {"node": name, "text": reports[name].message}
            for name in NODES
            if name in reports and reports[name].level != OK
        ]
        gone = [name for name in self._reports if name not in reports]
        return found + [
            {"node": name, "text": f"has not reported for {GONE_S:.0f} s: has it ended?"}
            for name in gone
        ]

    def value(self, node: str, key: str) -> str | None:
        """Return what a node reports as ``key``."""
        report = self.known().get(node)
        return None if report is None else report.values.get(key)

    def number(self, node: str, key: str) -> float | None:
        """Return a number that a node reports, None when it is none."""
        return _number(self.value(node, key))

    def foot(self, foot: str) -> dict[str, Any]:
        """Return the state of a foot, and rate, losses and battery of what arrives from it."""
        counted = self._counted(foot)
        return {"state": self._state(foot), **counted, "battery": self._battery(foot)}

    def _state(self, foot: str) -> str:
        state, phase = self.value(FUSION, f"{foot} foot"), self.value(FUSION, "phase")
        if state is None:
            return "no report"
        if state != FootState.OK:
            return state
        return "aligning" if phase == "aligning" else "tracking"

    def _counted(self, foot: str) -> dict[str, float | None]:
        """Return rate (Hz) and losses, by the first node on the way that counts them."""
        for node in (SYNC, FUSION):
            report = self.known().get(node)
            key = None if report is None else _counter(report, foot)
            if report is not None and key is not None:
                topic = key.removeprefix(RECEIVED)
                return {
                    "rate": report.rates.get(key),
                    "received": report.counts[key],
                    "lost": _sum(report.values.get(word + topic) for word in LOSSES),
                }
        return {"rate": None, "received": None, "lost": None}

    def _battery(self, foot: str) -> float | None:
        """Return the charge (%) that the adapter of a foot reports."""
        return self.number(ADAPTERS[foot], "battery (%)")


def _counter(report: Report, foot: str) -> str | None:
    """Return the name of the counter of a foot's samples; the feet come first, in their order."""
    used = [f for f in FEET if report.values.get(f"{f} foot") != FootState.UNUSED]
    return dict(zip(used, report.counts, strict=False)).get(foot)


def _read(status: DiagnosticStatus, before: Report | None, now_s: float) -> Report:
    values = {pair.key: pair.value for pair in status.values}
    counts = {key: _number(value) for key, value in values.items() if key.startswith(RECEIVED)}
    report = Report(status.level, status.message, values, now_s, counts, (now_s, counts))
    if before is not None:
        _count(report, before)
    return report


def _count(report: Report, before: Report) -> None:
    """Put the rates since the report that ``before`` counts from into ``report``."""
    since_s, counts = before.base
    passed_s = report.at_s - since_s
    if passed_s < LEAST_S:  # nodes report at once when a foot is lost or back
        report.base, report.rates = before.base, before.rates
        return
    for key, last in report.counts.items():
        first = counts.get(key)
        if first is not None and last is not None and last >= first:
            report.rates[key] = (last - first) / passed_s


def _sum(texts: Iterable[str | None]) -> float | None:
    """Return the sum of the numbers among ``texts``, None where there are none."""
    numbers = [number for number in map(_number, texts) if number is not None]
    return sum(numbers) if numbers else None


def _number(text: str | None) -> float | None:
    try:
        return None if text is None else float(text)
    except ValueError:
        return None
