"""Groups of the tracker's parameters: default, unit, range and meaning of each."""

from __future__ import annotations

from dataclasses import dataclass

from .errors import ConfigError
from .parameters import Parameters, parameter
from .samples.increments import Increments


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
class NoiseConfig(Parameters):
    """Sensor model: densities for Q, eq. (8) of Liu et al. 2023."""

    gyro: float = parameter(
        3.0e-3, "angular rate noise density", unit="rad/s/sqrt(Hz)", minimum=0.0, maximum=1.0
    )
    accelerometer: float = parameter(
        2.0e-2, "specific force noise density", unit="m/s^2/sqrt(Hz)", minimum=0.0, maximum=10.0
    )
    gyro_bias: float = parameter(
        2.0e-6, "gyro bias driving noise", unit="rad/s/sqrt(s)", minimum=0.0, maximum=1.0
    )
    accelerometer_bias: float = parameter(
        2.0e-5, "accelerometer bias driving noise", unit="m/s^2/sqrt(s)", minimum=0.0, maximum=1.0
    )
    bias_time: float = parameter(
        1800.0, "correlation time of the biases", unit="s", minimum=1.0, maximum=1e9
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


@dataclass(frozen=True)
class StanceConfig(Parameters):
    """GLRT stance detector (Skog et al. 2010) and the clean-up of impossible phases."""

    window: float = parameter(0.05, "GLRT window W", unit="s", minimum=0.005, maximum=0.5)
    detector: str = parameter(
        "adaptive",
        "threshold that follows the walk's own statistic, or fixed as in the papers",
        choices=("adaptive", "fixed"),
    )
    threshold: float = parameter(
        6000.0,
        "GLRT threshold gamma (dimensionless); adaptive: that of the first second",
        minimum=1.0,
        maximum=1e9,
    )
    gyro_std: float = parameter(
        1.4e-2, "angular rate noise in the GLRT", unit="rad/s", minimum=1e-6, maximum=1.0
    )
    force_std: float = parameter(
        4.2e-2, "specific force noise in the GLRT", unit="m/s^2", minimum=1e-6, maximum=10.0
    )
    min_stance: float = parameter(
        0.1, "a shorter stance is none", unit="s", minimum=0.0, maximum=1.0
    )
    min_swing: float = parameter(
        0.12, "a shorter swing is none", unit="s", minimum=0.0, maximum=1.0
    )


@dataclass(frozen=True)
class ZuptConfig(Parameters):
    """Zero-velocity update, eq. (12), at the point about which the foot pivots."""

    std: float = parameter(
        0.087, "velocity noise in stance", unit="m/s", minimum=1e-4, maximum=1.0
    )
    rate_std: float = parameter(
        0.12,
        "velocity noise added per angular rate",
        unit="m/s per rad/s",
        minimum=0.0,
        maximum=1.0,
    )
    std_rate: float = parameter(
        60.0,
        "sampling rate for which std and rate_std hold: the variance of a sample grows with the "
        "rate (0: the same at every rate, as in the papers)",
        unit="Hz",
        minimum=0.0,
        maximum=5000.0,
    )
    heading_correction: str = parameter(
        "none",
        "what a zero-velocity update corrects of heading and gyro bias: all (full), as in the "
        "papers, or nothing (none): they are taken as known, and their uncertainty is carried",
        choices=("full", "none"),
    )
    height_drift: float = parameter(
        3.0e-3,
        "vertical velocity they let through, alike in every stride and foot: so much less certain "
        "is the height, until a barometer, floor or pose gives it",
        unit="m/s",
        minimum=0.0,
        maximum=1.0,
    )
    bias_known: float = parameter(
        7.0e-3,
        "uncertainty of a gyro bias above which zero-velocity updates correct heading and bias "
        "all the same: they tell a bias to about this",
        unit="rad/s",
        minimum=0.0,
        maximum=10.0,
    )
    still_std: float = parameter(
        0.002, "velocity noise standing still", unit="m/s", minimum=1e-5, maximum=1.0
    )
    still_after: float = parameter(
        1.5, "a stance this long is standing still", unit="s", minimum=0.2, maximum=1e6
    )
    lever_arm: float = parameter(
        0.10,
        "height of the sensor above the pivot of the foot (0: the papers' plain ZUPT)",
        unit="m",
        minimum=0.0,
        maximum=0.5,
    )
    lever_back: float = parameter(
        0.06,
        "how far the pivot is behind the sensor, along the foot",
        unit="m",
        minimum=-0.3,
        maximum=0.3,
    )


@dataclass(frozen=True)
class FloorConfig(Parameters):
    """Floors that carry the person: lift, vehicle, escalator, moving walkway."""

    watch: bool = parameter(True, "look for floors that move, and follow them")
    landing_gate: float = parameter(
        0.99,
        "probability that the velocity with which a foot lands on a floor at rest stays within "
        "the gate (3 degrees of freedom); both feet beyond it, and alike, stand on a moving floor",
        minimum=0.5,
        maximum=0.999999,
    )


@dataclass(frozen=True)
class AidsConfig(Parameters):
    """What else is known of a standing foot; all off unless switched on."""

    flat_floor: bool = parameter(False, "walking on one level only: height zero in stance")
    floor_std: float = parameter(
        0.01, "unevenness of the floor", unit="m", minimum=1e-4, maximum=1.0
    )
    static_std: float = parameter(
        0.0,
        "flat_floor: how far a sensor moves on a standing foot (0: its place is no measurement); "
        "as in the paper, whose place is taken for known, so that the covariance is too small",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    barometer: bool = parameter(False, "height from air pressure in stance")
    barometer_std: float = parameter(
        0.3, "noise of a stance's mean pressure height", unit="m", minimum=1e-3, maximum=100.0
    )
    barometer_samples: int = parameter(
        3, "pressure samples needed in a stance", minimum=1, maximum=1000
    )
    magnetic_heading: bool = parameter(
        False, "heading from the magnetic field in stance, against that on the first stances"
    )
    magnetic_std: float = parameter(
        0.35,
        "error of the field's direction; what iron on the foot does to it repeats itself",
        unit="rad",
        minimum=0.01,
        maximum=3.0,
    )
    magnetic_iron_std: float = parameter(
        0.2,
        "the same once the walk has turned and the iron is learnt",
        unit="rad",
        minimum=0.01,
        maximum=3.0,
    )
    magnetic_size: float = parameter(
        0.06,
        "share by which the field's size may differ from the reference's",
        minimum=0.001,
        maximum=10.0,
    )
    magnetic_dip: float = parameter(
        0.07,
        "by how much its dip may differ from the reference's",
        unit="rad",
        minimum=0.001,
        maximum=3.2,
    )
    magnetic_stances: int = parameter(
        4, "stances in a row that must agree to be the reference", minimum=2, maximum=100
    )
    straight_lines: bool = parameter(
        False, "heading from straight walking: straights keep their direction and are parallel"
    )
    straight_strides: int = parameter(
        12, "strides of a foot in a row that make a straight", minimum=4, maximum=100
    )
    straight_bend: float = parameter(
        0.026,
        "by how much the halves of a straight may differ in direction",
        unit="rad",
        minimum=1e-3,
        maximum=0.5,
    )
    straight_gate: float = parameter(
        0.087,
        "by how much a straight may differ from one to which it is parallel",
        unit="rad",
        minimum=1e-3,
        maximum=0.7,
    )
    straight_std: float = parameter(
        0.05, "error of the direction of a straight", unit="rad", minimum=1e-3, maximum=1.0
    )
    straight_clip: float = parameter(
        0.0011,
        "by how much four strides on a straight turn the heading at most",
        unit="rad",
        minimum=1e-4,
        maximum=1.0,
    )
