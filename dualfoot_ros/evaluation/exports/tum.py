"""Tracks as TUM files, the text format that evo and others read.

One line a pose: ``seconds x y z qx qy qz qw``, metres, Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FootTrajectory, PoseSeries
from .number_text import BLOCK, lines, seconds

DECIMALS = 9


def write_tum(path: Path, track: FootTrajectory | PoseSeries) -> Path:
    """Write one track; the stamps keep their nanoseconds."""
    with path.open("wb") as file:
        for first in range(0, len(track), BLOCK):
            rows = slice(first, first + BLOCK)
            values = np.hstack([track.position[rows], track.quaternion[rows]])
            file.writelines(lines(seconds(track.stamp_ns[rows]), values, DECIMALS, " "))
    return path
