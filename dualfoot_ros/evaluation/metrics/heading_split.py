"""Heading errors of both feet, split into a common part and a difference.

A constraint between the feet can remove only the difference; the common part stays (see
``docs/reference/metrics.md``).  So the two are reported separately everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .accuracy import rms


@dataclass(frozen=True)
class HeadingErrors:
    """Degrees, counter-clockwise positive; ``end`` at the last epoch, ``rms`` over all."""

    common_end_deg: float
    common_rms_deg: float
    difference_end_deg: float
    difference_rms_deg: float
    left_end_deg: float
    right_end_deg: float


def split(left: FloatArray, right: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return common (mean) and difference (left minus right) of two (N,) errors in rad."""
    difference = np.asarray(left) - right
    difference = difference - 2 * np.pi * np.round(difference[:1] / (2 * np.pi))
    return right + difference / 2, difference


def heading_errors(left: FloatArray, right: FloatArray) -> HeadingErrors:
    """Summarise the (N,) heading errors (rad, unwrapped, equal stamps) of both feet."""
    common, difference = (np.degrees(part) for part in split(left, right))
    return HeadingErrors(
        common_end_deg=float(common[-1]),
        common_rms_deg=rms(common),
        difference_end_deg=float(difference[-1]),
        difference_rms_deg=rms(difference),
        left_end_deg=float(common[-1] + difference[-1] / 2),
        right_end_deg=float(common[-1] - difference[-1] / 2),
    )
