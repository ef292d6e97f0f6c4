"""The figure of a comparison: nothing lies on anything else."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_hex

from dualfoot_ros.evaluation.reports.plots import methods, style

from .entries import entries_of


def oval(low_m, high_m):
    turn = np.linspace(0.0, 2 * np.pi, 200)
    middle, half = (low_m + high_m) / 2, (high_m - low_m) / 2
    return np.column_stack([80.0 * np.cos(turn), half * np.sin(turn) + middle])


@pytest.fixture
def figure(tmp_path, monkeypatch):
    """Return the figure of three methods, of which one is wider than the others."""
    drawn = []
    monkeypatch.setattr(methods, "save", lambda made, path: drawn.append(made) or path)
    first = entries_of()[0]
    entries = []
    for name, track in {"zupt": oval(-10, 85), "idc": oval(0, 75), "own": oval(0, 75)}.items():
        tracks = replace(
            first.tracks, estimate={"left": track, "right": track}, truth={"left": oval(0, 75)}
        )
        entries.append(replace(first, tracks=tracks, case=replace(first.case, label=name)))
    methods.draw_compared(entries, tmp_path / "tracks.png", "a long walk")
    (made,) = drawn
    style.save(made, tmp_path / "tracks.png")
    return made


def test_titles_labels_and_legend_do_not_overlap(figure):
    heading = figure._suptitle.get_window_extent()
    (legend,) = figure.legends
    for axis in figure.axes:
        assert axis.title.get_window_extent().y1 <= heading.y0
        assert legend.get_window_extent().y1 <= axis.xaxis.label.get_window_extent().y0


def test_both_feet_show_where_one_lies_on_the_other(figure):
    tracks = [line for line in figure.axes[0].lines if len(line.get_xdata()) > 1]
    widths = {to_hex(line.get_color()): line.get_linewidth() for line in tracks}
    left, right = (widths[colour.lower()] for colour in style.FOOT.values())
    assert left >= right + 1.0
