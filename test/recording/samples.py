"""Recordings made up for the tests: a stand, then something that moves."""

import numpy as np

from dualfoot_ros.core import ImuSeries, PoseSeries, PressureSeries
from dualfoot_ros.recording import Recording, Reference

RATE_HZ = 100.0
GRAVITY = 9.80665


def moving(seed=0, *, count=1200, stand=500, start_ns=10**18, bias=(0.01, -0.02, 0.03)):
    """Return a foot that stands for ``stand`` samples and then swings, as in walking.

    Each second it pitches up and back, and moves on, in the first half second.
    """
    rng = np.random.default_rng(seed)
    stamps = start_ns + np.arange(count) * round(1e9 / RATE_HZ)
    force = rng.normal(0.0, 0.01, (count, 3)) + np.array([0.0, 0.0, GRAVITY])
    rate = rng.normal(0.0, 0.002, (count, 3)) + bias
    second = (np.arange(count - stand) / RATE_HZ) % 1.0
    swing = np.where(second < 0.5, np.sin(4 * np.pi * second), 0.0)
    pitch = np.where(second < 0.5, -7.0 / (4 * np.pi) * (1.0 - np.cos(4 * np.pi * second)), 0.0)
    rate[stand:, 1] -= 7.0 * swing
    force[stand:, 0] += 12.0 * swing * np.cos(pitch) - GRAVITY * np.sin(pitch)
    force[stand:, 2] += 12.0 * swing * np.sin(pitch) + GRAVITY * (np.cos(pitch) - 1.0)
    return ImuSeries(stamps, force, rate)


def truth(stamps, seed=0):
    """Return any true poses at ``stamps``."""
    rng = np.random.default_rng(seed)
    quaternion = rng.normal(size=(len(stamps), 4))
    quaternion /= np.linalg.norm(quaternion, axis=1)[:, None]
    return PoseSeries(
        np.asarray(stamps),
        rng.normal(size=(len(stamps), 3)),
        quaternion,
        rng.normal(size=(len(stamps), 3)),
    )


def pressure(stamps, seed=0, pascal=101325.0):
    """Return air pressure at about sea level with 2 Pa of noise."""
    noise = np.random.default_rng(seed).normal(0.0, 2.0, len(stamps))
    return PressureSeries(np.asarray(stamps), pascal + noise)


def recording(**parts):
    """Return a recording of two feet with everything a bag can hold."""
    left, right = moving(1), moving(2)
    field = np.random.default_rng(3).normal(size=(len(left), 3)) * 5e-5
    whole = {
        "left": ImuSeries(left.stamp_ns, left.specific_force, left.angular_rate, field),
        "right": right,
        "left_truth": truth(left.stamp_ns[::10]),
        "right_truth": truth(right.stamp_ns[::10], 1),
        "reference": Reference(
            "a tape measure", {"right": np.arange(6.0).reshape(2, 3)}, True, 12.5
        ),
        "pressure": {
            "left": pressure(left.stamp_ns[::4]),
            "right": pressure(right.stamp_ns[::4], 1),
            "both": pressure(left.stamp_ns[::8] + 5, 2, 95000.0),
        },
        "notes": {"source": "made up"},
    }
    return Recording(**(whole | parts))
