"""Simulated walks with known gyro matrices, for the tests of the fit."""

from dataclasses import replace
from functools import cache

import numpy as np

from dualfoot_ros.calibration.sensor import SensorCalibration, Triad
from dualfoot_ros.calibration.walk.foot_walk import FootWalk, foot_walk
from dualfoot_ros.core import DualFootTracker
from dualfoot_ros.inspection import unconstrained_config
from dualfoot_ros.recording import Recording, Reference
from dualfoot_ros.simulation import SensorConfig, Simulation, WalkConfig, simulate
from dualfoot_ros.timing import align

CALIBRATED = replace(
    SensorConfig(),
    accelerometer_scale=5e-4,
    accelerometer_misalignment=0.0,
    accelerometer_bias=0.02,
)
"""A consumer sensor whose accelerometer was calibrated."""
PIVOT = (0.10, 0.06)


@cache
def simulated(seed: int, route: str = "figure_eight", speed: float = 1.2) -> Simulation:
    """Return a walk; equal seeds are walked with the same sensors."""
    config = WalkConfig(route=route, rate=60.0, standing=4.0, speed=speed)
    return simulate(config, seed=seed, sensor=CALIBRATED)


@cache
def walks(seed: int, route: str = "figure_eight", speed: float = 1.2) -> dict[str, FootWalk]:
    """Return both feet of a walk as the fit needs them."""
    made, config = simulated(seed, route, speed), unconstrained_config()
    left, right = align(made.left, made.right)
    tracks = DualFootTracker(config).run(left, right)
    return {
        foot: foot_walk(series, tracks, foot, config)
        for foot, series in (("left", left), ("right", right))
    }


def recording(seed: int, route: str = "figure_eight", speed: float = 1.2) -> Recording:
    """Return the recording of a walk that is known to be a loop."""
    made = simulated(seed, route, speed)
    loop = Reference(source="simulated", closed_loop=True)
    return Recording(made.left, made.right, reference=loop)


def true_elements(seed: int, foot: str) -> np.ndarray:
    """Return xx, yy, zz, xy, xz, yz of the symmetric part of what undoes the gyro's errors."""
    made = simulated(seed)
    errors = made.left_errors if foot == "left" else made.right_errors
    undo = np.linalg.inv(np.eye(3) + errors.rate_matrix)
    s = 0.5 * (undo + undo.T) - np.eye(3)
    return np.array([s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2]])


def accelerometer(model: str) -> SensorCalibration:
    """Return a calibration that changes nothing, of that model."""
    return SensorCalibration(accelerometer=Triad(np.zeros(3), np.eye(3), {"model": model}))
