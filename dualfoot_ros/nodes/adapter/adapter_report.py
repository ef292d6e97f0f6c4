"""Report of the node ``imu_adapter``: its diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ...core import Refusal
from ...drivers import SensorCheck, SensorFault
from ...inspection import Finding, FindingKind, Severity
from ..ros.diagnostics import Rates
from ..ros.status import Described, Status
from .losses import LossReport

KINDS = {
    SensorFault.STUCK_SENSOR: FindingKind.STUCK,
    SensorFault.STUCK_AXIS: FindingKind.STUCK,
    SensorFault.WRONG_RATE: FindingKind.WRONG_RATE,
    SensorFault.CLIPPED_FORCE: FindingKind.CLIPPING,
    SensorFault.CLIPPED_RATE: FindingKind.CLIPPING,
}


class AdapterReport:
    """Report on the samples of one sensor, and on the parts that they go through."""

    def __init__(
        self,
        counters: Mapping[str, int],
        check: SensorCheck,
        parts: Sequence[Described],
        outcomes: Callable[[], Mapping[str, int]],
    ) -> None:
        """Report on the ``counters`` of the node, the ``check`` and the ``parts``.

        ``outcomes`` returns the counters of accepted, refused and lost samples.
        """
        self._counters, self._check, self._parts = counters, check, parts
        self._outcomes = outcomes
        self._rates, self._losses = Rates(), LossReport()

    def collect(self, status: Status) -> None:
        """Fill in a status."""
        rates = self._rates.since_last(self._counters)
        status.values["rate (Hz)"] = rates["relayed"]
        status.values |= self._counters
        status.values |= {name: n for name, n in self._check.counters.items() if n}
        status.values["sampling rate (Hz)"] = self._check.rate_hz
        for part in self._parts:
            part.describe(status)
        if rates[Refusal.NOT_FINITE] > 0:
            count = self._counters[Refusal.NOT_FINITE]
            text = f"samples are refused: {Refusal.NOT_FINITE.words} ({count} so far)"
            status.note(Finding(FindingKind.NOT_FINITE, Severity.WARNING, text))
        for fault, text in self._check.findings:
            status.note(Finding(KINDS[fault], Severity.WARNING, text, about=fault))
        self._losses.describe(self._outcomes(), status)
