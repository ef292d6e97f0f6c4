"""Tracks and strides of a report as text files."""

from __future__ import annotations

from pathlib import Path

from ..exports import write_tum
from ..gait import strides_csv
from ..whole_evaluation import Evaluation


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
