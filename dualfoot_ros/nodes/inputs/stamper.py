"""Stamps of samples by the policy of their foot, and what is known of the devices' clocks."""

from __future__ import annotations

import threading

from ...timing import ClockModel, ClockState, Stamping, Stamps
from ..ros.diagnostics import ERROR, WARN, Status

LARGEST_NS = (1 << 31) * 1_000_000_000  # what a stamp of ROS can hold
LONG = 4.0  # times clock.settle
IN_STEP = (
    "the offset of the {foot} foot's clock is known to {state.offset_std_s:.3f} s only: the "
    "device sends in step with its link, which delivers every {state.interval_s:.4f} s; change "
    "either"
)


class Stamper:
    """Stamps the samples of the feet; may be asked and told from different threads.

    ``counters`` holds ``settling`` (samples withheld at first, until the clock of their device is
    known) and ``not_stamped``: samples whose clock says that they are not to be used, or whose
    time no message can hold.
    """

    def __init__(self, stamping: Stamping, model: ClockModel) -> None:
        self.counters = {"settling": 0, "not_stamped": 0}
        self._stamps, self._model = Stamps(stamping, model), model
        self._reported = 0
        self._lock = threading.Lock()

    def stamp(self, foot: str, header_ns: int, arrival_ns: int) -> int | None:
        """Return the stamp in ns of one sample; None: it is not to be used."""
        with self._lock:
            found = self._stamps.stamp(foot, header_ns, arrival_ns)
            if found is None and self._stamps.settling(foot):
                self.counters["settling"] += 1
                return None
        if found is not None and not 0 <= found < LARGEST_NS:
            found = None
        self.counters["not_stamped"] += found is None
        return found

    @property
    def states(self) -> dict[str, ClockState]:
        """What is known about the clock of every foot whose policy is ``device``."""
        with self._lock:
            return self._stamps.states

    def describe(self, status: Status) -> None:
        """Put the clocks that are followed into a report."""
        for foot, state in self.states.items():
            status.values |= clock_values(foot, state)
            if state.phase == "refused":
                status.note(ERROR, self._refusal(foot, state), f"clock {foot} refused")
            elif state.phase == "settling":
                status.note(WARN, self._settling(foot, state))
            elif self._in_step(state):
                status.note(WARN, IN_STEP.format(foot=foot, state=state), f"clock {foot} in step")
        status.values |= {f"clock {name}": n for name, n in self._stamps.counters.items()}
        status.values |= self.counters
        if self.counters["not_stamped"] > self._reported:
            status.note(WARN, "samples are refused: their stamps contradict the arrivals")
        self._reported = self.counters["not_stamped"]

    def _in_step(self, state: ClockState) -> bool:
        """Tell whether the waits for the events of a link hide the offset of a clock."""
        unsure = state.offset_std_s > self._model.tracking_std
        return unsure and state.age_s > LONG * self._model.settle and state.interval_s > 0.0

    def _refusal(self, foot: str, state: ClockState) -> str:
        return (
            f"the clock of the {foot} foot is off by {state.skew_ppm:.0f} ppm; beyond "
            f"{self._model.max_skew:g} ppm it is not fused: check the unit of its stamps"
        )

    def _settling(self, foot: str, state: ClockState) -> str:
        said = f"the clock of the {foot} foot is being learnt: {state.age_s:.1f} s so far"
        if state.age_s > LONG * self._model.settle:
            return f"{said}, too long: check the link and the unit of its stamps"
        return f"{said}; its samples are withheld until it is known"


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
