"""Tracks as TUM files, the text format that evo and others read.

One line a pose: ``seconds x y z qx qy qz qw``, metres, Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FootTrajectory, PoseSeries
from .number_text import lines, seconds

DECIMALS = 9


def write_tum(path: Path, track: FootTrajectory | PoseSeries) -> Path:
    """Write one track; the stamps keep their nanoseconds."""
    rows = np.hstack([track.position, track.quaternion])
    with path.open("wb") as file:
        file.writelines(lines(seconds(track.stamp_ns), rows, DECIMALS, " "))
    return path
