"""The distance between the feet, with the moments at which a method constrained it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....core import FloatArray, row_distances, swing_passings
from ...frames.association import seconds
from ...whole_evaluation import Evaluation, constraint_epochs
from .style import GREEN, PINK, TRUTH, new_figure, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LONG_S = 200.0
"""On longer walks the swings are too near to each other to be told apart."""

BANDS = 700


def draw_distance(runs: Mapping[str, Evaluation], path: Path, title: str) -> Path:
    """Draw one panel for each run."""
    figure, axes = new_figure(11.0, 0.9 + 2.4 * len(runs), rows=len(runs), sharex=True)
    for axis, (name, run) in zip(axes.flat, runs.items(), strict=True):
        _panel(axis, run)
        axis.set_title(name, fontsize=10, loc="left")
        axis.set_ylabel("distance (m)")
        axis.set_ylim(0.0, 1.25 * axis.get_ylim()[1])  # room for the legend
        axis.legend(loc="upper left", fontsize=8, ncols=4, framealpha=0.9)
    axes[-1, 0].set_xlabel("time since start (s)")
    figure.suptitle(f"{title}: distance between the feet", fontsize=11)
    return save(figure, path)


def _panel(axis: Axes, run: Evaluation) -> None:
    left, right = run.trajectory.left, run.trajectory.right
    time = seconds(left.stamp_ns, int(left.stamp_ns[0]))
    both = left.present & right.present
    apart = row_distances(left.position, right.position)
    apart[~both] = np.nan
    if run.truth is not None:
        true = row_distances(run.truth[0].position, run.truth[1].position)
        _curve(axis, time, true, TRUTH, "truth")
    _curve(axis, time, apart, "#444444", "estimate")
    dot = 4.0 if time[-1] <= LONG_S else 1.5
    applied = constraint_epochs(run.trajectory)
    refused = constraint_epochs(run.trajectory, accepted=False)
    if len(applied) + len(refused) == 0:
        passed = swing_passings(left.position, right.position, left.stance, right.stance)
        passed = passed.where(both)
        axis.plot(
            time[passed.index], passed.distance_m, ".", color=GREEN, ms=dot, label="feet pass"
        )
        return
    axis.plot(time[applied], apart[applied], "o", color=GREEN, ms=dot, label="constraint applied")
    if len(refused):
        label = "constraint not applied"
        axis.plot(time[refused], apart[refused], "x", color=PINK, ms=5, label=label)


def _curve(axis: Axes, time: FloatArray, values: FloatArray, colour: str, name: str) -> None:
    """Draw a curve; on a long walk its least and largest values, with the truth as a band."""
    if time[-1] <= LONG_S:
        width = 1.8 if colour == TRUTH else 0.6
        axis.plot(time, values, color=colour, linewidth=width, label=name)
        return
    starts = np.unique(np.linspace(0, len(values) - 1, BANDS).astype(np.int64))
    low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    label = f"{name}, least to largest"
    if colour == TRUTH:
        axis.fill_between(
            time[starts], low, high, step="post", color=colour, alpha=0.6, linewidth=0, label=label
        )
        return
    for edge, words in ((low, None), (high, label)):
        axis.plot(time[starts], edge, color=colour, linewidth=0.6, label=words)
