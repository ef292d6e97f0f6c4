"""The figures of a comparison: all tracks from above, and figures over a swept parameter."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..comparison_rows import by_case, over_bags
from .style import FOOT, GREEN, MARKER, PINK, TRUTH, legend_above, new_figure, save, wrapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ...batch import Entry

WIDEST = 12.0  # inches
WIDTHS = (2.0, 0.8)  # of the lines of the feet, so that both show where one lies on the other


def draw_compared(entries: Sequence[Entry], path: Path, title: str) -> Path:
    """Draw every method's two tracks on one bag, a panel each, all to the same scale."""
    count = len(entries)
    width, height = _panel_size(entries)
    columns = min(int(WIDEST / width), count)
    rows = math.ceil(count / columns)
    size = max(5.0, width * columns), height * rows + 1.2
    figure, axes = new_figure(*size, rows, columns, sharex=True, sharey=True)
    for axis in axes.flat[count:]:
        axis.set_axis_off()
    for axis, entry in zip(axes.flat, entries, strict=False):
        _panel(axis, entry)
    for axis in axes[:, 0]:
        axis.set_ylabel("y (m)")
    for column in range(columns):
        lowest = axes[(count - 1 - column) // columns, column]
        lowest.set_xlabel("x (m)")
        lowest.tick_params(labelbottom=True)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8, frameon=False)
    how = entries[0].metrics["alignment"]["words"]
    figure.suptitle(
        wrapped(f"{title}: both feet from above", f"aligned by {how}", size[0]), fontsize=10
    )
    return save(figure, path)


def _panel_size(entries: Sequence[Entry]) -> tuple[float, float]:
    """Return width and height of a panel that holds the usual track, not the worst of all."""
    spans = [np.ptp(np.vstack(list(e.tracks.estimate.values())), axis=0) + 1.0 for e in entries]
    span = np.median(spans, axis=0)
    height = float(np.clip(3.4 * span[1] / span[0], 1.9, 4.2))
    return float(np.clip(height * span[0] / span[1] + 0.4, 1.7, 4.0)), height + 0.3


def _panel(axis: Axes, entry: Entry) -> None:
    for number, truth in enumerate(entry.tracks.truth.values()):
        label = "truth" if number == 0 else None
        axis.plot(*truth.T, color=TRUTH, linewidth=2.4, label=label)
    for foot, points in entry.tracks.markers.items():
        label = f"floor markers ({foot} foot)"
        axis.plot(*points.T, "s", mfc="none", mec=MARKER, markersize=5, label=label)
    for (foot, track), width in zip(entry.tracks.estimate.items(), WIDTHS, strict=False):
        axis.plot(*track.T, color=FOOT[foot], linewidth=width, label=f"{foot} foot")
        label, size = f"end of the {foot} foot", 4 + 2.5 * width
        axis.plot(*track[-1], "X", color=FOOT[foot], mec="black", markersize=size, label=label)
    axis.set_title(entry.case.label, fontsize=9)
    axis.set_aspect("equal", adjustable="box")


SWEPT = (
    ("midpoint_end_m", "end error of the mid-point (m)", FOOT["left"]),
    ("right_marker_rmse_m", "marker RMSE (m)", FOOT["right"]),
    ("closure_mean_m", "closure (m)", GREEN),
    ("feet_crossed_percent", "feet crossed (%)", PINK),
)


def draw_sweep(rows: Sequence[dict[str, Any]], name: str, path: Path) -> Path:
    """Draw the figures over a swept parameter, the median over the bags, a line a method."""
    own = [row for row in rows if row["swept"] == name]
    shown = [item for item in SWEPT if any(row.get(item[0]) is not None for row in own)]
    figure, axes = new_figure(4.2 * len(shown), 3.4, columns=len(shown))
    methods = list(dict.fromkeys(row["method"] for row in own))
    for axis, (column, label, colour) in zip(axes.flat, shown, strict=True):
        for index, method in enumerate(methods):
            cases = by_case(row for row in own if row["method"] == method).values()
            points = [(case[0]["value"], over_bags(case, column)) for case in cases]
            style = ("-", "--", ":", "-.")[index % 4]
            axis.plot(*zip(*points, strict=True), style, marker="o", color=colour, label=method)
        axis.set_xlabel(name)
        axis.set_ylabel(label)
        axis.set_ylim(bottom=0.0)
        if len(methods) > 1:
            legend_above(axis, 2)
    return save(figure, path)
