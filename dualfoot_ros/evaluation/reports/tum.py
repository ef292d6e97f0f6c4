"""Trajectories as TUM files, the text format that evo and others read.

One line a pose: ``seconds x y z qx qy qz qw``, metres, Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FootTrajectory, PoseSeries
from ..evaluate import Evaluation


def write_tum(path: Path, track: FootTrajectory | PoseSeries) -> Path:
    """Write one track; the stamps keep their nanoseconds."""
    seconds, nanoseconds = np.divmod(track.stamp_ns, 1_000_000_000)
    rows = np.hstack([track.position, track.quaternion])
    with path.open("w", encoding="ascii") as file:
        for s, ns, row in zip(seconds, nanoseconds, rows, strict=True):
            file.write(f"{s}.{ns:09d} " + " ".join(f"{value:.9f}" for value in row) + "\n")
    return path


def write_tracks(directory: Path, evaluation: Evaluation, prefix: str = "") -> list[Path]:
    """Write both feet and, where known, their truth at the same stamps; return the paths.

    The estimates are in the frame of the reference, as they were aligned for the figures.
    """
    paths = [
        write_tum(directory / f"{prefix}{foot}.tum", track)
        for foot, track in evaluation.feet_tracks.items()
    ]
    for foot, truth in zip(evaluation.feet_tracks, evaluation.truth or (), strict=False):
        paths.append(write_tum(directory / f"{prefix}{foot}_truth.tum", truth))
    return paths
