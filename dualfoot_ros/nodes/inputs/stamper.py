"""Stamps of samples by the policy of their foot, and the state of the devices' clocks."""

from __future__ import annotations

import threading

from ...core import Refusal
from ...inspection import Finding, FindingKind, Severity
from ...timing import ClockState, DeviceClockConfig, StampConfig, Stamps
from ..ros.status import Status

LARGEST_NS = (1 << 31) * 1_000_000_000  # a stamp of ROS can hold no more
LONG = 4.0  # times clock.settle
IN_STEP = (
    "the offset of the {foot} foot's clock is known to {state.offset_std_s:.3f} s only: the "
    "device sends in step with its link, which delivers every {state.interval_s:.4f} s"
)


class Stamper:
    """Stamps for the samples of the feet; may be used from different threads.

    ``counters`` holds ``settling`` (samples withheld at first, until the clock of their device is
    known) and ``not_stamped``: samples which their clock refuses, or whose time no message can
    hold.
    """

    def __init__(self, stamping: StampConfig, model: DeviceClockConfig) -> None:
        self.counters: dict[str, int] = {Refusal.SETTLING: 0, Refusal.NOT_STAMPED: 0}
        self._stamps, self._model = Stamps(stamping, model), model
        self._reported = 0
        self._lock = threading.Lock()

    def stamp(self, foot: str, header_ns: int, arrival_ns: int) -> int | None:
        """Return the stamp in ns of one sample; None when the sample is not to be used."""
        with self._lock:
            stamp_ns = self._stamps.stamp(foot, header_ns, arrival_ns)
            if stamp_ns is None and self._stamps.settling(foot):
                self.counters[Refusal.SETTLING] += 1
                return None
        if stamp_ns is not None and not 0 <= stamp_ns < LARGEST_NS:
            stamp_ns = None
        self.counters[Refusal.NOT_STAMPED] += stamp_ns is None
        return stamp_ns

    @property
    def states(self) -> dict[str, ClockState]:
        """State of the clock of every foot whose policy is ``device``."""
        with self._lock:
            return self._stamps.states

    def describe(self, status: Status) -> None:
        """Add the clocks that are followed, and the refused samples, to a status."""
        for foot, state in self.states.items():
            status.values |= clock_values(foot, state)
            finding = self._check_clock(foot, state)
            if finding is not None:
                status.note(finding)
        status.values |= {f"clock {name}": n for name, n in self._stamps.counters.items()}
        status.values |= self.counters
        refused = self.counters[Refusal.NOT_STAMPED]
        if refused > self._reported:
            text = f"samples are refused: {Refusal.NOT_STAMPED.words}"
            status.note(Finding(FindingKind.NOT_STAMPED, Severity.WARNING, text))
        self._reported = refused

    def _check_clock(self, foot: str, state: ClockState) -> Finding | None:
        if state.phase == "refused":
            text = self._describe_refused(foot, state)
            return Finding(FindingKind.CLOCK_REFUSED, Severity.ERROR, text, about=foot)
        if state.phase == "settling":
            text = self._describe_settling(foot, state)
            return Finding(FindingKind.CLOCK_SETTLING, Severity.WARNING, text, about=foot)
        if self._is_in_step(state):
            text = IN_STEP.format(foot=foot, state=state)
            kind = FindingKind.CLOCK_IN_STEP
            return Finding(kind, Severity.WARNING, text, "change either", foot)
        return None

    def _is_in_step(self, state: ClockState) -> bool:
        """Return whether the waits for the events of a link hide the offset of a clock."""
        unsure = state.offset_std_s > self._model.tracking_std
        return unsure and state.age_s > LONG * self._model.settle and state.interval_s > 0.0

    def _describe_refused(self, foot: str, state: ClockState) -> str:
        return (
            f"the clock of the {foot} foot is off by {state.skew_ppm:.0f} ppm; beyond "
            f"{self._model.max_skew:g} ppm it is not fused: check the unit of its stamps"
        )

    def _describe_settling(self, foot: str, state: ClockState) -> str:
        text = f"the clock of the {foot} foot is being learnt: {state.age_s:.1f} s so far"
        if state.age_s > LONG * self._model.settle:
            return f"{text}, too long: check the link and the unit of its stamps"
        return f"{text}; its samples are withheld until it is known"


def clock_values(foot: str, state: ClockState) -> dict[str, str | float | int]:
    """Return the state of a clock as named values; host minus device, to the microsecond."""
    values: dict[str, str | float | int] = {
        f"{foot} clock": state.phase,
        f"{foot} offset (s)": f"{state.offset_ns * 1e-9:.6f}",
        f"{foot} offset uncertainty (s)": state.offset_std_s,
        f"{foot} skew (ppm)": state.skew_ppm,
        f"{foot} skew uncertainty (ppm)": state.skew_std_ppm,
        f"{foot} delay (s)": state.delay_s,
        f"{foot} clock resets": state.epoch,
    }
    if state.interval_s > 0.0:
        values[f"{foot} link interval (s)"] = state.interval_s
    return values
