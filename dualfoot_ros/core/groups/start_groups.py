"""Parameters of what a track starts from: the samples, the stand, the first strides, P0."""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import ConfigError
from ..parameters import Parameters, parameter
from ..samples.increments import Increments

FROM_SOURCE = "from_source"
KINDS = (FROM_SOURCE, *(kind.value for kind in Increments))


@dataclass(frozen=True)
class IncrementsConfig(Parameters):
    """What the samples of each foot are; the source says so unless it is given here."""

    left: str = parameter(
        FROM_SOURCE,
        "samples of the left foot; from_source: as its recording or driver says, else averaged",
        choices=KINDS,
    )
    right: str = parameter(
        FROM_SOURCE,
        "samples of the right foot; from_source: as its recording or driver says, else averaged",
        choices=KINDS,
    )

    def of(self, foot: str, source: Increments | None) -> Increments:
        """Return what the samples of ``foot`` are; ``source`` is what their source says."""
        given = self.left if foot == "left" else self.right
        return (source or Increments.AVERAGED) if given == FROM_SOURCE else Increments(given)

    def is_given(self, foot: str) -> bool:
        """Return whether it is given here for ``foot``, whatever the source says."""
        return (self.left if foot == "left" else self.right) != FROM_SOURCE


@dataclass(frozen=True)
class AlignmentConfig(Parameters):
    """Levelling and gyro bias from a standstill, weighed by its stillness; motion is refused."""

    duration: float = parameter(
        2.0,
        "quiet standstill of both feet after which output starts at once",
        unit="s",
        minimum=0.5,
        maximum=60.0,
    )
    patience: float = parameter(
        10.0,
        "time after the first usable stand, or without one after the first sample, at which "
        "output starts with what is there",
        unit="s",
        minimum=0.0,
        maximum=600.0,
    )
    last_stand: bool = parameter(
        True,
        "offline, a stand at the end of the walk tells of the gyro bias too (off: the same bits "
        "as live, where the end is not known)",
    )
    window: float = parameter(
        0.75, "length of the window that is weighed", unit="s", minimum=0.1, maximum=5.0
    )
    still_rate_std: float = parameter(
        1.0e-3,
        "angular rate scatter below which windows count alike; above it by 1 / scatter^4",
        unit="rad/s",
        minimum=1e-6,
        maximum=1.0,
    )
    quiet_rate_std: float = parameter(
        0.03, "angular rate scatter of a quiet window", unit="rad/s", minimum=1e-5, maximum=1.0
    )
    quiet_force_std: float = parameter(
        0.15, "specific force scatter of a quiet window", unit="m/s^2", minimum=1e-4, maximum=5.0
    )
    max_rate_std: float = parameter(
        0.12,
        "angular rate scatter above which a window is motion",
        unit="rad/s",
        minimum=1e-5,
        maximum=1.0,
    )
    max_force_std: float = parameter(
        0.6,
        "specific force scatter above which a window is motion",
        unit="m/s^2",
        minimum=1e-4,
        maximum=5.0,
    )
    max_rate: float = parameter(
        0.15,
        "mean angular rate (a bias) above which a window is motion",
        unit="rad/s",
        minimum=0.0,
        maximum=1.0,
    )
    max_gravity_error: float = parameter(
        1.0, "mean specific force may differ from g by", unit="m/s^2", minimum=0.01, maximum=5.0
    )


@dataclass(frozen=True)
class HeadingConfig(Parameters):
    """What the x axis of the navigation frame is."""

    source: str = parameter(
        "first_strides",
        "x axis along the first strides, along the sensors' own x axes, or given for both feet",
        choices=("first_strides", "sensor", "given"),
    )
    given: float = parameter(
        0.0,
        "heading of the first strides in the navigation frame (source: given)",
        unit="rad",
        minimum=-6.3,
        maximum=6.3,
    )
    from_stance: int = parameter(1, "first stance that fixes the direction", minimum=0, maximum=20)
    to_stance: int = parameter(3, "last stance that fixes the direction", minimum=1, maximum=40)

    def __post_init__(self) -> None:
        """Check that the two stances are in order."""
        super().__post_init__()
        if self.from_stance >= self.to_stance:
            raise ConfigError(
                f"parameter 'heading.to_stance' is {self.to_stance}; allowed is more than "
                f"heading.from_stance, {self.from_stance}"
            )


@dataclass(frozen=True)
class InitialConfig(Parameters):
    """Standard deviations of the initial error state (P0)."""

    position: float = parameter(0.02, "position", unit="m", minimum=0.0, maximum=100.0)
    velocity: float = parameter(0.01, "velocity", unit="m/s", minimum=0.0, maximum=10.0)
    tilt: float = parameter(0.01, "roll and pitch", unit="rad", minimum=0.0, maximum=1.0)
    yaw: float = parameter(
        0.01, "yaw against the first strides", unit="rad", minimum=0.0, maximum=3.2
    )
    gyro_bias: float = parameter(
        8.0e-4, "lower bound of the gyro bias", unit="rad/s", minimum=0.0, maximum=1.0
    )
    accelerometer_bias: float = parameter(
        0.1, "accelerometer bias", unit="m/s^2", minimum=0.0, maximum=5.0
    )
    spacing: float = parameter(
        0.15, "lateral distance of the feet at the start", unit="m", minimum=0.0, maximum=1.0
    )
