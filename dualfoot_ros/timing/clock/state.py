"""What is known about a device's clock."""

from __future__ import annotations

from dataclasses import dataclass

PHASES = ("empty", "settling", "acquiring", "tracking", "refused")


@dataclass(frozen=True)
class ClockState:
    """What is known about a device's clock.

    Attributes
    ----------
    phase : "empty", "settling" (samples are withheld), "acquiring" (sensible, not yet good),
        "tracking", or "refused" (bad skew)
    age_s : time on the host's clock since the first arrival of this epoch, s
    offset_ns : host minus device at the newest sample, least delay included
    offset_std_s : its standard deviation, s; nan while nothing is known
    skew_ppm : how much faster the device's clock runs
    skew_std_ppm : its standard deviation
    delay_s : mean delay of the fastest arrivals above the least one, s
    interval_s : of the events at which the link delivers, s; nan when there are none, or too few
        notifications came to tell
    epoch : restarts and jumps so far
    """

    phase: str
    age_s: float
    offset_ns: int
    offset_std_s: float
    skew_ppm: float
    skew_std_ppm: float
    delay_s: float
    interval_s: float
    epoch: int
