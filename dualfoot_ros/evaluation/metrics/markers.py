"""Errors against floor markers: stance k of one foot stood on marker k."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .accuracy import rms


@dataclass(frozen=True)
class MarkerErrors:
    """Horizontal distances of the stances of one foot from the markers it stood on.

    Attributes
    ----------
    foot : "left" or "right"
    stances, markers : their numbers; only when equal is stance k matched to marker k
    rmse_m, max_m, end_m : None when the numbers differ
    errors_m : the distance at each marker
    """

    foot: str
    stances: int
    markers: int
    rmse_m: float | None
    max_m: float | None
    end_m: float | None
    errors_m: list[float]


def marker_errors(foot: str, stood: FloatArray, markers: FloatArray) -> MarkerErrors:
    """Compare (M, 3) aligned stance positions with the (K, 3) markers of the same foot."""
    if len(stood) != len(markers):
        return MarkerErrors(foot, len(stood), len(markers), None, None, None, [])
    error = np.linalg.norm((stood - markers)[:, :2], axis=1)
    return MarkerErrors(
        foot=foot,
        stances=len(stood),
        markers=len(markers),
        rmse_m=rms(error),
        max_m=float(error.max()),
        end_m=float(error[-1]),
        errors_m=error.tolist(),
    )
