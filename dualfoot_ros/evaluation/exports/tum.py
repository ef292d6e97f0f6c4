"""Tracks as TUM files, the text format that evo and others read.

One line a pose: ``seconds x y z qx qy qz qw``, metres, Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FloatArray, FootTrajectory, PoseSeries
from .text_table import Form, write_table

FORM = Form(places=9, decimals=9, separator=" ")


def write_tum(path: Path, track: FootTrajectory | PoseSeries) -> Path:
    """Write one track; the stamps keep their nanoseconds."""

    def poses(rows: slice) -> FloatArray:
        """Return position and quaternion (K, 7) of some epochs."""
        return np.hstack([track.position[rows], track.quaternion[rows]])

    with path.open("wb") as file:
        write_table(file, track.stamp_ns, poses, FORM)
    return path
