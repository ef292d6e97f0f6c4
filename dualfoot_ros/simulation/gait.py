"""The shape of one swing, over its phase q from heel-off (0) to flat foot (1).

The shapes were drawn by eye after the angular rates of real walks with sensors on the instep: slow
heel rise, push-off at 8-9 rad/s, swing back at 6-7 rad/s, slap of the sole after heel strike.

Roll and yaw of a swing that cones are the means over the strides of two real laps, moved by at
most 0.08 rad (most keys by less than 0.01) until the coning terms of push-off, swing and heel
strike and the greatest angular rates are those of these laps.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from ..core import FloatArray
from .footprints import HEEL_STRIKE, TOE_OFF

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

FOOT_LENGTH_M = 0.17  # from the heel's edge to the ball
MIDDLE_M = 0.17  # from the point about which the flat foot turns to the ball

_KEYS = {
    # nose-down pitch, rad
    "pitch": (
        (
            0.0,
            0.08,
            0.16,
            0.22,
            TOE_OFF,
            0.33,
            0.37,
            0.42,
            0.56,
            0.73,
            HEEL_STRIKE,
            0.89,
            0.93,
            0.96,
            1,
        ),
        (
            0.0,
            0.04,
            0.15,
            0.36,
            0.68,
            1.02,
            1.08,
            0.98,
            0.42,
            -0.16,
            -0.42,
            -0.23,
            -0.09,
            -0.035,
            0,
        ),
    ),
    # outward lean, rad
    "roll": (
        (0.0, 0.12, TOE_OFF, 0.36, 0.50, 0.66, HEEL_STRIKE, 0.90, 0.96, 1.0),
        (0.0, 0.02, -0.06, 0.10, -0.03, 0.06, 0.16, 0.08, 0.01, 0.0),
    ),
    # outward turn, rad
    "yaw": (
        (0.0, 0.12, TOE_OFF, 0.38, 0.55, 0.70, HEEL_STRIKE, 0.92, 1.0),
        (0.0, 0.01, 0.12, 0.22, 0.02, -0.08, 0.03, 0.02, 0.0),
    ),
    # the same two of a swing that cones as real ones do
    "coning_roll": (
        (
            0.0,
            0.12,
            0.20,
            TOE_OFF,
            0.33,
            0.38,
            0.45,
            0.56,
            0.66,
            0.74,
            0.79,
            HEEL_STRIKE,
            0.88,
            0.93,
            0.97,
            1.0,
        ),
        (
            0.0,
            -0.014,
            0.08,
            0.009,
            -0.188,
            -0.151,
            -0.021,
            -0.061,
            0.013,
            0.097,
            0.162,
            0.241,
            0.231,
            0.078,
            0.028,
            0.0,
        ),
    ),
    "coning_yaw": (
        (0.0, 0.12, 0.20, TOE_OFF, 0.33, 0.38, 0.45, 0.55, 0.66, 0.74, HEEL_STRIKE, 0.92, 1.0),
        (0.0, 0.013, 0.022, -0.007, 0.194, 0.146, -0.043, -0.023, -0.028, -0.015, 0.04, -0.008, 0),
    ),
    # share of the turn to the next footprint; a tenth is done pivoting on the ball
    "turn": (
        (0.0, 0.10, TOE_OFF, 0.53, HEEL_STRIKE, 1.0),
        (0.0, 0.01, 0.10, 0.55, 0.97, 1.0),
    ),
    # lift of the ball, relative
    "lift": (
        (0.0, TOE_OFF, 0.38, 0.55, 0.70, HEEL_STRIKE, 1.0),
        (0.0, 0.1, 1.0, 0.6, 0.5, 0.0, 0.0),
    ),
}


@cache
def _template(name: str) -> PchipInterpolator:
    from scipy.interpolate import PchipInterpolator

    phase, value = _KEYS[name]
    return PchipInterpolator(phase, value)


def shape(name: str, phase: FloatArray) -> FloatArray:
    """Return a template (pitch, roll, yaw, turn or lift) at ``phase`` (N,) in [0, 1]."""
    values: FloatArray = _template(name)(phase)
    return values


def turned(name: str, phase: FloatArray, coning: float) -> FloatArray:
    """Return roll or yaw at ``phase`` (N,), rad, of a swing that cones by this share of real ones.

    With 0 the shapes are those drawn by eye, which cone a third as much and the other way round.
    """
    plain = shape(name, phase)
    return plain + coning * (shape(f"coning_{name}", phase) - plain)


def advance(phase: FloatArray, skew: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the share of the way the ball has gone, and a bump that is 1 half-way.

    ``skew`` in (-0.2, 0.2) lets the foot pass the half earlier (positive) or later.
    """
    u = np.clip((phase - TOE_OFF) / (HEEL_STRIKE - TOE_OFF), 0.0, 1.0)
    u = u + 4.0 * skew * u * (1.0 - u)
    return u * u * (3.0 - 2.0 * u), 16.0 * u * u * (1.0 - u) ** 2


def climb(phase: FloatArray, rise: FloatArray) -> FloatArray:
    """Return the share of ``rise`` done: early on the way up, late on the way down."""
    u = (phase - TOE_OFF) / (HEEL_STRIKE - TOE_OFF)
    low = np.where(rise > 0, 0.0, 0.45)
    u = np.clip((u - low) / 0.55, 0.0, 1.0)
    return u * u * (3.0 - 2.0 * u)


def sole_height(pitch: FloatArray) -> FloatArray:
    """Return the height of the ball, m, when the heel touches the floor (nose-up pitch).

    The sole gives: the ball touches softly while the shoe still has about two degrees to go.
    """
    lack = -np.sin(pitch) - 0.04
    return 0.5 * FOOT_LENGTH_M * (lack + np.sqrt(lack * lack + 0.04**2))


def give(pitch: FloatArray, slow: FloatArray) -> FloatArray:
    """Return by how much the ball yields, m downwards, as the shoe first turns about its middle.

    Slow rotation of the stance (``slow``, rad) and the first of the heel's rise (``pitch``, rad)
    turn the shoe about a point behind the sensor, 12 cm behind the ball; only then the ball takes
    over.  On real walks plain ZUPT climbs by 15-30 mm a stride because of that.
    """
    first = 0.08 * np.tanh(np.maximum(pitch, 0.0) / 0.08)
    return MIDDLE_M * (first + slow)


def ringing(since_strike_s: FloatArray) -> FloatArray:
    """Return the ringing of the shoe after heel strike, of unit amplitude."""
    x = np.clip(since_strike_s, 0.0, 0.5)
    return np.sin(2.0 * np.pi * 25.0 * x) * np.exp(-x / 0.02)
