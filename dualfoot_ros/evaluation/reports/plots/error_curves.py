"""Errors over the walked distance: position of each foot, heading common and difference."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....core import FEET, FloatArray
from ...frames.association import Footfalls
from ...metrics.accuracy import heading_error
from ...metrics.heading_split import split
from ...whole_evaluation import Evaluation
from .style import FOOT, GREEN, LINES, PINK, legend_above, new_figure, save, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE, NARROW = 2.8, 1.1


def draw_errors(runs: Mapping[str, Evaluation], path: Path, title: str) -> Path:
    """Draw position and heading errors against the truth, one line style a run."""
    figure, axes = new_figure(9.0, 6.4, rows=2, sharex=True)
    for style, (name, run) in zip(_styles(len(runs)), runs.items(), strict=True):
        turns = []
        for foot, truth in zip(FEET, run.truth or (), strict=False):
            track = run.feet_tracks[foot]
            some, label = thinned(len(track)), f"{name} {foot}"
            walked = Footfalls.of(track).walked(truth.position, truth.stamp_ns)[some].copy()
            error = np.linalg.norm(track.position[some] - truth.position[some], axis=1)
            # On a long walk both lie on each other: the first is wide, so that both show.
            width = WIDE if foot == FEET[0] else NARROW
            axes[0, 0].plot(walked, error, style, color=FOOT[foot], lw=width, label=label)
            turn = heading_error(track.quaternion, truth.quaternion)
            turns.append(_in_stance(turn, track.stance, some))
        _heading(axes[1, 0], walked, turns, style, name)
    axes[0, 0].set_ylim(bottom=0.0)
    axes[0, 0].set_ylabel("position error (m)")
    axes[1, 0].set_ylabel("heading error in stance (deg)")
    axes[1, 0].set_xlabel("distance walked (m)")
    for axis in axes.flat:
        legend_above(axis)
    how = next(iter(runs.values())).alignment_name
    figure.suptitle(f"{title}: errors over distance\naligned by {how}", fontsize=10)
    return save(figure, path)


def _in_stance(values: FloatArray, stance: np.ndarray, some: slice = slice(None)) -> FloatArray:
    """Return ``some`` of the values (N,) as they were in stance, joined by straight lines.

    In the swing a foot turns fast, and the least difference of time makes spikes.
    """
    index = np.arange(len(values))
    if not stance.any():
        return np.array(values[some])  # else the figure holds the whole
    joined: FloatArray = np.interp(index[some], index[stance], values[stance])
    return joined


def _heading(
    axis: Axes, walked: FloatArray, turns: list[FloatArray], style: str, name: str
) -> None:
    common, difference = (np.degrees(part) for part in split(turns[0], turns[1]))
    axis.plot(walked, common, style, color=GREEN, lw=1.1, label=f"{name} common")
    axis.plot(
        walked, difference, style, color=PINK, lw=1.1, label=f"{name} difference (left - right)"
    )


def draw_marker_errors(runs: Mapping[str, Evaluation], path: Path, title: str) -> Path:
    """Draw the error at each floor marker over the way along the markers."""
    figure, axes = new_figure(9.0, 4.0)
    axis = axes[0, 0]
    for style, (name, run) in zip(_styles(len(runs)), runs.items(), strict=True):
        for foot, report in run.marker_report.items():
            if not report.errors_m:
                continue
            steps = np.linalg.norm(np.diff(run.markers[foot], axis=0), axis=1)
            way = np.concatenate([[0.0], np.cumsum(steps)])
            label = f"{name} {foot} foot, RMSE {report.rmse_m:.3f} m"
            axis.plot(way, report.errors_m, f"o{style}", ms=4, color=FOOT[foot], label=label)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("distance along the markers (m)")
    axis.set_ylabel("error at the marker (m)")
    legend_above(axis, 2)
    how = next(iter(runs.values())).options.words("markers")
    figure.suptitle(f"{title}: errors at the floor markers\naligned by {how}", fontsize=10)
    return save(figure, path)


def _styles(count: int) -> list[str]:
    return [LINES[k % len(LINES)] for k in range(count)]
