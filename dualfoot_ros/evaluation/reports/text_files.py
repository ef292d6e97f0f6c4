"""Tracks and strides of a report as text files.

TUM is the format that evo and others read, one line a pose: ``seconds x y z qx qy qz qw``, metres,
Hamilton quaternion body to navigation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FootTrajectory, PoseSeries
from ..evaluate import Evaluation
from ..gait import strides_csv


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


def write_strides(directory: Path, evaluation: Evaluation) -> Path:
    """Write ``strides.csv``, one row a stride, and return its path."""
    path = directory / "strides.csv"
    path.write_text(strides_csv(evaluation.gait.strides), encoding="utf-8")
    return path
