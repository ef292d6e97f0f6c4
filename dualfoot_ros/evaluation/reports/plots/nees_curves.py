"""NEES along the walk, with the band of a consistent filter."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .style import FOOT, GREEN, new_figure, save

if TYPE_CHECKING:
    from ...batch import Score

COLOURS = {"left": FOOT["left"], "right": FOOT["right"], "relative": GREEN}


def draw_consistency(scores: Sequence[Score], path: Path, title: str) -> Path:
    """Draw the ensemble NEES over its dimensions, a panel a kind of quantity."""
    curves = [score for score in scores if score.curve is not None]
    kinds = list(dict.fromkeys(score.name.partition(" ")[2] for score in curves))
    panels = {kind: [s for s in curves if s.name.partition(" ")[2] == kind] for kind in kinds}
    columns = math.ceil(len(panels) / 2)
    figure, axes = new_figure(3.8 * columns, 6.0, 2, columns, sharex=True, sharey=True)
    for axis in axes.flat[len(panels) :]:
        axis.set_axis_off()
    for axis, (kind, own) in zip(axes.flat, panels.items(), strict=False):
        for score in own:
            whose = score.name.partition(" ")[0]
            curve = np.asarray(score.curve)
            along = np.linspace(0.0, 100.0, len(curve))
            axis.plot(along, curve, color=COLOURS[whose], linewidth=1.1, label=whose)
        low, high = own[0].curve_band or (1.0, 1.0)
        axis.axhspan(low, high, color="#E8E8E8", zorder=0, label="95 % band")
        axis.axhline(1.0, color="black", linewidth=0.6)
        axis.set_yscale("log")
        axis.set_title(kind, fontsize=10)
    for axis in axes[-1]:
        axis.set_xlabel("share of the walk (%)")
    for axis in axes[:, 0]:
        axis.set_ylabel("NEES over dimensions")
    names = {
        label: handle
        for axis in axes.flat
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True)
    }
    place = {"loc": "outside lower center", "ncols": len(names)}  # below, where no curve runs
    figure.legend(names.values(), names.keys(), fontsize=8, frameon=False, **place)
    figure.suptitle(title, fontsize=11)
    return save(figure, path)
