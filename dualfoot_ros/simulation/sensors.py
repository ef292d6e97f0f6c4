"""The errors of an inertial sensor, from the true motion to its output, and the kind of output.

In this order: scale and misalignment, g-sensitivity, turn-on bias, warm-up drift, bias instability
(first-order Gauss-Markov), white noise, saturation, quantisation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core import FloatArray, Increments, Parameters, SimulationError, parameter
from .noise import gauss_markov

_RATE = "rad/s"
_FORCE = "m/s^2"


@dataclass(frozen=True)
class SensorConfig(Parameters):
    """Sizes of the errors; the defaults are those of a consumer sensor such as the Xsens DOT.

    Sizes named "spread" are standard deviations from one sensor (and axis) to the next.
    """

    errors: str = parameter(
        "independent",
        "how the two feet's errors go together: drawn apart, or mirror images of each other "
        "(noise and instability are independent always)",
        choices=("independent", "mirrored"),
    )
    increments: str = parameter(
        "averaged",
        "what a sample is: compensated increments of a device with a clock of 800 Hz inside, the "
        "mean over its interval, or the value at its stamp",
        choices=tuple(kind.value for kind in Increments),
    )
    gyro_noise: float = parameter(
        1.2e-4, "white noise density", unit="rad/s/sqrt(Hz)", minimum=0.0, maximum=0.1
    )
    accelerometer_noise: float = parameter(
        1.2e-3, "white noise density", unit="m/s^2/sqrt(Hz)", minimum=0.0, maximum=1.0
    )
    gyro_bias: float = parameter(
        1.5e-2, "spread of the turn-on bias", unit=_RATE, minimum=0.0, maximum=0.5
    )
    accelerometer_bias: float = parameter(
        0.10, "spread of the turn-on bias", unit=_FORCE, minimum=0.0, maximum=2.0
    )
    gyro_instability: float = parameter(
        5.0e-5, "bias instability", unit=_RATE, minimum=0.0, maximum=0.1
    )
    accelerometer_instability: float = parameter(
        5.0e-4, "bias instability", unit=_FORCE, minimum=0.0, maximum=1.0
    )
    instability_time: float = parameter(
        300.0, "correlation time of the instability", unit="s", minimum=1.0, maximum=1e6
    )
    gyro_scale: float = parameter(5.0e-3, "spread of the scale factor", minimum=0.0, maximum=0.1)
    accelerometer_scale: float = parameter(
        5.0e-3, "spread of the scale factor", minimum=0.0, maximum=0.1
    )
    gyro_misalignment: float = parameter(
        3.0e-3, "spread of the axes' misalignment", unit="rad", minimum=0.0, maximum=0.1
    )
    accelerometer_misalignment: float = parameter(
        3.0e-3, "spread of the axes' misalignment", unit="rad", minimum=0.0, maximum=0.1
    )
    g_sensitivity: float = parameter(
        1.0e-4,
        "spread of rate per specific force",
        unit="rad/s per m/s^2",
        minimum=0.0,
        maximum=0.01,
    )
    gyro_warm_up: float = parameter(
        5.0e-4, "spread of the bias lost while warming up", unit=_RATE, minimum=0.0, maximum=0.1
    )
    accelerometer_warm_up: float = parameter(
        1.0e-2, "spread of the bias lost while warming up", unit=_FORCE, minimum=0.0, maximum=1.0
    )
    warm_up_time: float = parameter(
        200.0, "time constant of warming up", unit="s", minimum=1.0, maximum=1e5
    )
    gyro_range: float = parameter(
        34.9, "full scale (0: no limit)", unit=_RATE, minimum=0.0, maximum=1e3
    )
    accelerometer_range: float = parameter(
        156.9, "full scale (0: no limit)", unit=_FORCE, minimum=0.0, maximum=1e4
    )
    gyro_resolution: float = parameter(
        1.07e-3, "least step of the output (0: none)", unit=_RATE, minimum=0.0, maximum=0.1
    )
    accelerometer_resolution: float = parameter(
        4.8e-3, "least step of the output (0: none)", unit=_FORCE, minimum=0.0, maximum=1.0
    )


def _ideal() -> SensorConfig:
    return SensorConfig.from_mapping(
        {s.name: 0.0 for s in SensorConfig.specs() if s.minimum == 0.0}
    )


def _good() -> SensorConfig:
    return SensorConfig(
        gyro_noise=4.0e-5,
        accelerometer_noise=4.0e-4,
        gyro_bias=2.0e-3,
        accelerometer_bias=0.02,
        gyro_instability=1.0e-5,
        accelerometer_instability=1.0e-4,
        gyro_scale=1.0e-3,
        accelerometer_scale=1.0e-3,
        gyro_misalignment=5.0e-4,
        accelerometer_misalignment=5.0e-4,
        g_sensitivity=2.0e-5,
        gyro_warm_up=5.0e-5,
        accelerometer_warm_up=1.0e-3,
        gyro_resolution=1.0e-4,
        accelerometer_resolution=5.0e-4,
    )


GRADES = {"ideal": _ideal, "good": _good, "consumer": SensorConfig}


def grade(name: str, errors: str = "independent") -> SensorConfig:
    """Return the sensor of that grade.

    Raises
    ------
    SimulationError
        When there is no such grade.
    """
    if name not in GRADES:
        raise SimulationError(f"grade is '{name}'; allowed is one of {', '.join(GRADES)}")
    return replace(GRADES[name](), errors=errors)


@dataclass(frozen=True)
class SensorErrors:
    """The errors of one sensor, as drawn.

    ``force_matrix`` and ``rate_matrix`` (3, 3) are added to the identity, ``g_matrix`` (3, 3) maps
    specific force to rate; biases and warm-up amplitudes are (3,).
    """

    force_matrix: FloatArray
    rate_matrix: FloatArray
    g_matrix: FloatArray
    force_bias: FloatArray
    rate_bias: FloatArray
    force_warm_up: FloatArray
    rate_warm_up: FloatArray

    @classmethod
    def draw(cls, config: SensorConfig, rng: np.random.Generator) -> SensorErrors:
        """Draw one sensor of the kind."""
        normal = rng.standard_normal
        return cls(
            force_matrix=_matrix(
                config.accelerometer_scale, config.accelerometer_misalignment, rng
            ),
            rate_matrix=_matrix(config.gyro_scale, config.gyro_misalignment, rng),
            g_matrix=config.g_sensitivity * normal((3, 3)),
            force_bias=config.accelerometer_bias * normal(3),
            rate_bias=config.gyro_bias * normal(3),
            force_warm_up=config.accelerometer_warm_up * normal(3),
            rate_warm_up=config.gyro_warm_up * normal(3),
        )

    def mirrored(self) -> SensorErrors:
        """Return the errors of the mirror image of this sensor, left and right exchanged.

        Specific force is a polar vector and keeps x and z, the angular rate is axial and keeps y.
        """
        polar = np.diag([1.0, -1.0, 1.0])
        axial = -polar
        return SensorErrors(
            force_matrix=polar @ self.force_matrix @ polar,
            rate_matrix=axial @ self.rate_matrix @ axial,
            g_matrix=axial @ self.g_matrix @ polar,
            force_bias=polar @ self.force_bias,
            rate_bias=axial @ self.rate_bias,
            force_warm_up=polar @ self.force_warm_up,
            rate_warm_up=axial @ self.rate_warm_up,
        )


def draw_pair(
    config: SensorConfig, rngs: tuple[np.random.Generator, np.random.Generator]
) -> tuple[SensorErrors, SensorErrors]:
    """Draw the errors of the left and the right sensor, independent or mirror images."""
    left = SensorErrors.draw(config, rngs[0])
    right = SensorErrors.draw(config, rngs[1])
    return left, left.mirrored() if config.errors == "mirrored" else right


def measure(
    config: SensorConfig,
    errors: SensorErrors,
    time_s: FloatArray,
    force: FloatArray,
    rate: FloatArray,
    rng: np.random.Generator,
) -> tuple[FloatArray, FloatArray]:
    """Return the (N, 3) specific force and rate that the sensor puts out for the true means."""
    interval = float(np.median(np.diff(time_s))) if len(time_s) > 1 else 1.0
    warm = np.exp(-time_s / config.warm_up_time)[:, None]
    sensed_rate = rate + rate @ errors.rate_matrix.T + force @ errors.g_matrix.T
    sensed_rate += errors.rate_bias + errors.rate_warm_up * warm
    sensed_rate += _noise_and_instability(
        config.gyro_noise, config.gyro_instability, config, interval, len(rate), rng
    )
    sensed_force = force + force @ errors.force_matrix.T
    sensed_force += errors.force_bias + errors.force_warm_up * warm
    sensed_force += _noise_and_instability(
        config.accelerometer_noise,
        config.accelerometer_instability,
        config,
        interval,
        len(force),
        rng,
    )
    return (
        _saturate_and_quantise(
            sensed_force, config.accelerometer_range, config.accelerometer_resolution
        ),
        _saturate_and_quantise(sensed_rate, config.gyro_range, config.gyro_resolution),
    )


def _matrix(scale: float, misalignment: float, rng: np.random.Generator) -> FloatArray:
    matrix = misalignment * rng.standard_normal((3, 3))
    np.fill_diagonal(matrix, scale * rng.standard_normal(3))
    return matrix


def _noise_and_instability(
    noise: float,
    instability: float,
    config: SensorConfig,
    interval_s: float,
    count: int,
    rng: np.random.Generator,
) -> FloatArray:
    """Return (N, 3) white noise of that density plus a Gauss-Markov bias of that deviation."""
    white = noise / np.sqrt(interval_s) * rng.standard_normal((count, 3))
    keep = np.exp(-interval_s / config.instability_time)
    drift = gauss_markov(keep, rng.standard_normal((count, 3)))
    drifting: FloatArray = white + instability * drift
    return drifting


def _saturate_and_quantise(value: FloatArray, full_scale: float, resolution: float) -> FloatArray:
    if full_scale > 0.0:
        value = np.clip(value, -full_scale, full_scale)
    if resolution > 0.0:
        value = resolution * np.round(value / resolution)
    return value
