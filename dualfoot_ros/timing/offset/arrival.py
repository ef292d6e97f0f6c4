"""The clock of a device over a whole recording, from its stamps and the log times."""

from __future__ import annotations

import numpy as np

from ...core import IntArray, TimingError
from ..clock.clock_config import DeviceClockConfig
from ..clock.device_clock import DeviceClock
from .result import Offset

BINS = 240
GOOD_STD_S = 0.003  # uncertainty that is a confidence of one half
LEAST_S = 5.0


def tells_arrivals(stamp_ns: IntArray, arrival_ns: IntArray) -> bool:
    """Tell whether the log times (N,) say more than the stamps (N,): a delay that varies."""
    return len(stamp_ns) > 1 and bool(np.ptp(arrival_ns - stamp_ns) > 1000)


def offset_by_arrival(foot: str, stamp_ns: IntArray, arrival_ns: IntArray) -> Offset:
    """Return what to add to the stamps (N,) of ``foot`` to bring them to the host's clock.

    One straight line under all arrivals; the least delay of the link stays in it.

    Raises
    ------
    TimingError
        When the recording is too short, a clock jumps within it, or its skew is impossible.
    """
    span_s = 1e-9 * float(np.ptp(stamp_ns)) if len(stamp_ns) else 0.0
    if span_s < LEAST_S:
        raise TimingError(
            f"the {foot} foot was recorded for {span_s:.1f} s; {LEAST_S:g} s are needed to tell "
            "its clock from the arrivals"
        )
    horizon = min(max(2.0 * span_s, 10.0), 86_400.0)
    clock = DeviceClock(DeviceClockConfig(horizon=horizon, bin=max(horizon / BINS / 2.0, 0.05)))
    for device_ns, arrived_ns in zip(stamp_ns.tolist(), arrival_ns.tolist(), strict=True):
        clock.update(device_ns, arrived_ns)
    _check(foot, clock)
    state, middle_ns = clock.state, (int(stamp_ns[0]) + int(stamp_ns[-1])) // 2
    offset_ns, std_s = clock.line_at(middle_ns)
    return Offset(
        method="arrival",
        offset_ns=offset_ns,
        center_ns=middle_ns,
        skew_ppm=state.skew_ppm,
        skew_known=True,
        std_s=std_s,
        confidence=1.0 / (1.0 + (std_s / GOOD_STD_S) ** 2),
        detail={"skew_std_ppm": state.skew_std_ppm, "delay_s": state.delay_s},
    )


def _check(foot: str, clock: DeviceClock) -> None:
    if clock.epoch:
        raise TimingError(
            f"the clock of the {foot} foot or of the host jumps within the recording "
            f"({clock.epoch} times); cut it there"
        )
    if clock.state.phase == "refused":
        raise TimingError(
            f"the clock of the {foot} foot is off by {clock.state.skew_ppm:.0f} ppm; allowed is "
            f"{clock.config.max_skew:g} ppm; is its stamp in the unit it is taken for?"
        )
