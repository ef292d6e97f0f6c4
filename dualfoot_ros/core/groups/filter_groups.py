"""Parameters of the filter: noise, stance detector, zero velocity, the floor."""

from __future__ import annotations

from dataclasses import dataclass

from ..parameters import Parameters, parameter


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
