"""Parameters of the model of a device's clock."""

from __future__ import annotations

from dataclasses import dataclass

from ...core import Parameters, parameter


@dataclass(frozen=True)
class DeviceClockConfig(Parameters):
    """How the clock of a device is followed on the host's clock."""

    horizon: float = parameter(
        120.0,
        "arrivals older than this are forgotten; longer is steadier, shorter follows warming up",
        unit="s",
        minimum=5.0,
        maximum=86_400.0,
    )
    bin: float = parameter(
        0.5,
        "of each such stretch of device time only the fastest arrival is kept",
        unit="s",
        minimum=0.05,
        maximum=600.0,
    )
    skew_scale: float = parameter(
        100.0,
        "usual skew of such devices; until the arrivals tell, less is believed",
        unit="ppm",
        minimum=1.0,
        maximum=10_000.0,
    )
    max_skew: float = parameter(
        10_000.0,
        "a clock that is surely worse is reported and its samples are refused",
        unit="ppm",
        minimum=10.0,
        maximum=40_000.0,
    )
    delay: float = parameter(
        0.0,
        "least delay from sample to arrival, where it is known; it cannot be observed",
        unit="s",
        minimum=0.0,
        maximum=10.0,
    )
    settle: float = parameter(
        5.0,
        "time from the first arrival until samples are stamped however uncertain the offset is, "
        "and until the model can count as tracking",
        unit="s",
        minimum=0.0,
        maximum=600.0,
    )
    tracking_std: float = parameter(
        0.005,
        "uncertainty of the offset below which stamping begins, and the model counts as tracking",
        unit="s",
        minimum=1.0e-6,
        maximum=1.0,
    )
    time_constant: float = parameter(
        1.0,
        "time in which a correction of the offset is worked in",
        unit="s",
        minimum=0.1,
        maximum=60.0,
    )
    max_slew: float = parameter(
        5000.0,
        "fastest such correction while tracking; the stamps never step",
        unit="ppm",
        minimum=10.0,
        maximum=100_000.0,
    )
    jump: float = parameter(
        0.1,
        "shift of all arrivals that is a jump of a clock; longer than a connection interval",
        unit="s",
        minimum=0.001,
        maximum=10.0,
    )
    jump_after: float = parameter(
        5.0,
        "time all arrivals must be late before that is a jump",
        unit="s",
        minimum=0.5,
        maximum=600.0,
    )

    @property
    def bins(self) -> int:
        """Number of fastest arrivals that are kept."""
        return max(3, round(self.horizon / self.bin))
