"""Tracks as TUM files, the text format that evo and others read.

One line a pose: ``seconds x y z qx qy qz qw``, metres, Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FootTrajectory, PoseSeries


def write_tum(path: Path, track: FootTrajectory | PoseSeries) -> Path:
    """Write one track; the stamps keep their nanoseconds."""
    seconds, nanoseconds = np.divmod(track.stamp_ns, 1_000_000_000)
    rows = np.hstack([track.position, track.quaternion])
    with path.open("w", encoding="ascii") as file:
        for s, ns, row in zip(seconds, nanoseconds, rows, strict=True):
            file.write(f"{s}.{ns:09d} " + " ".join(f"{value:.9f}" for value in row) + "\n")
    return path
