"""Which time a sample of each foot gets: that of its header, its device's clock or its arrival."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...core import FEET, Parameters, parameter
from .clock_config import DeviceClockConfig
from .device_clock import DeviceClock
from .even_clock import EvenClock
from .state import ClockState

POLICIES = ("header", "device", "arrival", "even")


@dataclass(frozen=True)
class StampConfig(Parameters):
    """Where the stamps of the two feet come from.

    ``header`` takes them as they are; ``device`` takes them as time of the device's own clock and
    follows that on the host's; ``arrival`` takes the time the sample arrived, which is good for
    links without bursts only; ``even`` takes the jitter off headers that are times of arrival (or
    off the arrivals, where they are zero), for a sensor that samples regularly.
    """

    left: str = parameter("header", "stamps of the left foot", choices=POLICIES)
    right: str = parameter("header", "stamps of the right foot", choices=POLICIES)
    left_offset: float = parameter(
        0.0, "added to the left foot's stamps", unit="s", minimum=-1.0e9, maximum=1.0e9
    )
    right_offset: float = parameter(
        0.0, "added to the right foot's stamps", unit="s", minimum=-1.0e9, maximum=1.0e9
    )
    agreement: str = parameter(
        "separate",
        "separate: each device has its clock; shared: the devices keep one clock between them "
        "(Xsens DOT after its synchronisation), so a difference of their links cannot come in",
        choices=("separate", "shared"),
    )

    def policy(self, foot: str) -> str:
        """Return the policy of ``foot``, "left" or "right"."""
        return self.left if foot == "left" else self.right

    def offset_ns(self, foot: str) -> int:
        """Return what is added to the stamps of ``foot``, ns."""
        return round(1e9 * (self.left_offset if foot == "left" else self.right_offset))


class Stamps:
    """Stamp the samples of both feet on the host's clock, by the policy of each foot.

    The offset between the feet is what the fusion feels.  With one clock each it is wrong by the
    difference of the least delays of the two links, which cancels for equal links and cannot be
    observed otherwise; ``agreement: shared`` removes it for devices that keep one clock.
    """

    def __init__(
        self, config: StampConfig | None = None, model: DeviceClockConfig | None = None
    ) -> None:
        self.config = config or StampConfig()
        one = DeviceClock(model)
        shared = self.config.agreement == "shared"
        self.clocks: Mapping[str, DeviceClock | EvenClock] = {
            foot: EvenClock(model)
            if self.config.policy(foot) == "even"
            else (one if shared else DeviceClock(model))
            for foot in FEET
            if self.config.policy(foot) in ("device", "even")
        }

    def stamp(self, foot: str, header_ns: int, arrival_ns: int) -> int | None:
        """Return the stamp in ns of one sample; None: its clock says it is not to be used.

        With the policies ``device`` and ``even`` that is so for all samples of the first seconds:
        see :meth:`settling`.
        """
        policy = self.config.policy(foot)
        if policy in ("device", "even"):
            found = self.clocks[foot].update(header_ns, arrival_ns)
        else:
            found = header_ns if policy == "header" else arrival_ns
        return None if found is None else found + self.config.offset_ns(foot)

    def settling(self, foot: str) -> bool:
        """Tell whether the samples of ``foot`` are withheld until its clock is known."""
        return foot in self.clocks and self.clocks[foot].state.phase == "settling"

    @property
    def states(self) -> dict[str, ClockState]:
        """What is known about the clock of every foot that has one to follow."""
        return {foot: clock.state for foot, clock in self.clocks.items()}

    @property
    def counters(self) -> dict[str, int]:
        """What became of the arrivals, as ``left_late`` and so on."""
        return {f"{f}_{k}": n for f, c in self.clocks.items() for k, n in c.counters.items()}
