"""Both tracks from above, against truth or floor markers."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....core import FEET, FloatArray
from ...exports import FloorPlan
from ...frames.association import Footfalls
from ...whole_evaluation import Evaluation
from .style import FOOT, MARKER, TRUTH, new_figure, save, thinned, wrapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABEL_IN = 1.5
"""Width of a label of the legend in the mean, inches."""

MOST_DOTS = 80
"""Stances are dotted on walks of no more than this many."""

WIDE = 2.4
MARGIN = 0.08
"""Of the size of the tracks, shown of a floor plan around them."""


def draw_tracks(
    runs: Mapping[str, Evaluation], path: Path, title: str, floor_plan: FloorPlan | None = None
) -> Path:
    """Draw one panel for each run, all to the same scale, over a floor plan where one is given."""
    width, height = _panel_size(runs)
    figure, axes = new_figure(
        max(4.5, width * len(runs)), height + 1.4, columns=len(runs), sharex=True, sharey=True
    )
    for axis, (name, run) in zip(axes.flat, runs.items(), strict=True):
        _panel(axis, run)
        if floor_plan is not None:
            _lay_under(axis, run, floor_plan)
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("x (m)")
    axes[0, 0].set_ylabel("y (m)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    columns = max(2, int(figure.get_figwidth() / LABEL_IN))
    figure.legend(
        handles, labels, loc="outside lower center", ncols=columns, fontsize=8, frameon=False
    )
    how = next(iter(runs.values())).alignment_name
    heading = f"{title}: tracks from above"
    figure.suptitle(wrapped(heading, f"aligned by {how}", figure.get_figwidth()), fontsize=10)
    return save(figure, path)


def _panel_size(runs: Mapping[str, Evaluation]) -> tuple[float, float]:
    tracks = [run.feet_tracks[foot] for run in runs.values() for foot in run.tracked_feet]
    ends = [
        [end(track.position[:, axis]) for track in tracks for end in (np.min, np.max)]
        for axis in range(2)
    ]
    span = np.ptp(ends, axis=1) + 1.0
    height = float(np.clip(6.5 * span[1] / span[0], 1.6, 7.5))
    return float(np.clip(height * span[0] / span[1] + 0.9, 3.2, 7.5)), height


def _panel(axis: Axes, run: Evaluation) -> None:
    for number, truth in enumerate(run.truth or ()):
        label = "truth" if number == 0 else None
        axis.plot(*_from_above(truth.position), color=TRUTH, linewidth=3.6, label=label)
    for foot, points in run.markers.items() if run.aligned_to == "markers" else ():
        axis.plot(
            *points[:, :2].T,
            "s",
            markerfacecolor="none",
            markeredgecolor=MARKER,
            markersize=8,
            label=f"floor markers ({foot} foot)",
        )
    for foot in run.tracked_feet:
        track, colour = run.feet_tracks[foot], FOOT[foot]
        falls = Footfalls.of(track)
        # On a long walk both lines lie on each other: the first is wide, so that both show.
        width = WIDE if foot == FEET[0] and len(falls) > MOST_DOTS else 0.9
        axis.plot(
            *_from_above(track.position), color=colour, linewidth=width, label=f"{foot} foot"
        )
        if len(falls) <= MOST_DOTS:
            axis.plot(*falls.mean(track.position)[:, :2].T, ".", color=colour, markersize=4)
    _ends(axis, run)
    axis.set_aspect("equal", adjustable="box")


def _lay_under(axis: Axes, run: Evaluation, plan: FloorPlan) -> None:
    """Draw the picture under the tracks; the axes keep to the tracks."""
    from matplotlib.image import imread
    from matplotlib.transforms import Affine2D

    place = plan.picture(run.person)
    left, top = place["x"] - place["left"], place["y"] + place["up"]
    turn = Affine2D().rotate_deg_around(place["x"], place["y"], place["angle"])
    axis.margins(MARGIN)
    limits = axis.get_xlim(), axis.get_ylim()
    axis.grid(visible=False)
    axis.imshow(
        imread(io.BytesIO(plan.png)),
        extent=(left, left + place["width"], top - place["height"], top),
        transform=turn + axis.transData,
        cmap="gray",
        zorder=0,
    )
    axis.set(xlim=limits[0], ylim=limits[1])


def _from_above(position: FloatArray) -> FloatArray:
    """Return x and y (2, K) of a line through (N, 3) positions, to its end."""
    shown = position[thinned(len(position)), :2]
    return np.vstack([shown, position[-1:, :2]]).T


def _ends(axis: Axes, run: Evaluation) -> None:
    tracks = [run.feet_tracks[foot] for foot in run.tracked_feet]
    for index, symbol, label in ((0, "^", "start"), (-1, "X", "end")):
        x, y = np.mean([t.position[index, :2] for t in tracks], axis=0)
        axis.plot(
            x,
            y,
            symbol,
            markersize=9,
            markerfacecolor="#F0E442",
            markeredgecolor="black",
            linestyle="none",
            label=label,
            zorder=5,
        )
