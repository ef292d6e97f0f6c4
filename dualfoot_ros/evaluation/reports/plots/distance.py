"""The distance between the feet, with the moments at which a method constrained it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....core import swing_passings
from ...evaluate import Evaluation, constraint_epochs
from ...frames.association import seconds
from .style import GREEN, PINK, TRUTH, new_figure, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_distance(runs: Mapping[str, Evaluation], path: Path, title: str) -> Path:
    """Draw one panel for each run."""
    figure, axes = new_figure(11.0, 0.9 + 2.4 * len(runs), rows=len(runs), sharex=True)
    for axis, (name, run) in zip(axes.flat, runs.items(), strict=True):
        _panel(axis, run)
        axis.set_title(name, fontsize=10, loc="left")
        axis.set_ylabel("distance (m)")
        axis.set_ylim(0.0, 1.25 * axis.get_ylim()[1])  # room for the legend
        axis.legend(loc="upper right", fontsize=8, ncols=4, framealpha=0.9)
    axes[-1, 0].set_xlabel("time since start (s)")
    figure.suptitle(f"{title}: distance between the feet", fontsize=11)
    return save(figure, path)


def _panel(axis: Axes, run: Evaluation) -> None:
    left, right = run.trajectory.left, run.trajectory.right
    time = seconds(left.stamp_ns, int(left.stamp_ns[0]))
    apart = np.linalg.norm(left.position - right.position, axis=1)
    if run.truth is not None:
        true = np.linalg.norm(run.truth[0].position - run.truth[1].position, axis=1)
        axis.plot(time, true, color=TRUTH, linewidth=1.8, label="truth")
    axis.plot(time, apart, color="#444444", linewidth=0.6, label="estimate")
    applied = constraint_epochs(run.trajectory)
    refused = constraint_epochs(run.trajectory, accepted=False)
    if len(applied) + len(refused) == 0:
        passed = swing_passings(left.position, right.position, left.stance, right.stance)
        axis.plot(time[passed.index], passed.distance_m, ".", color=GREEN, label="feet pass")
        return
    axis.plot(time[applied], apart[applied], "o", color=GREEN, ms=4, label="constraint applied")
    if len(refused):
        label = "constraint not applied"
        axis.plot(time[refused], apart[refused], "x", color=PINK, ms=5, label=label)
