"""When each foot stood: two strips a line, so many seconds a line."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ....core import stance_bounds
from ...frames.association import seconds
from ...whole_evaluation import Evaluation
from .style import FOOT, new_figure, save

ROW_S = 20.0
LONGEST_ROW_S = 100.0  # on which a stance still shows
MOST_ROWS = 12
Bar = tuple[float, float]  # start and length, s


def draw_stances(run: Evaluation, path: Path, title: str) -> Path:
    """Draw the stances of the feet from the start of the estimate."""
    stamps = run.trajectory.left.stamp_ns
    time = seconds(stamps, int(stamps[0]))
    row_s = _row_s(float(time[-1]))
    rows = max(1, math.ceil(time[-1] / row_s))
    shown = min(rows, MOST_ROWS)
    figure, axes = new_figure(11.0, 1.2 + 0.75 * shown, rows=shown)
    feet = {foot: _bars(time, run.feet_tracks[foot].stance) for foot in run.tracked_feet}
    for number, axis in enumerate(axes.flat):
        for level, (foot, stood) in enumerate(reversed(feet.items())):
            bars = _within(stood, number * row_s, (number + 1) * row_s)
            axis.broken_barh(bars, (level + 0.1, 0.8), color=FOOT[foot], linewidth=0)
        axis.set_xlim(number * row_s, (number + 1) * row_s)
        axis.set_xticks(np.arange(11) * row_s / 10 + number * row_s)
        axis.set_ylim(0, len(feet))
        axis.set_yticks([level + 0.5 for level in range(len(feet))], list(reversed(feet)))
        axis.grid(visible=False, axis="y")
    axes[-1, 0].set_xlabel("time since start (s)")
    part = "" if rows == shown else f", the first {shown * row_s:g} s of {time[-1]:.0f} s"
    figure.suptitle(f"{title}: stance phases{part}", fontsize=11)
    return save(figure, path)


def _row_s(time_s: float) -> float:
    """Return the seconds of a line: more on a long walk, so that all of it is shown."""
    lines = math.ceil(time_s / (MOST_ROWS * ROW_S))
    return min(max(1, lines) * ROW_S, LONGEST_ROW_S)


def _within(bars: list[Bar], start_s: float, end_s: float) -> list[Bar]:
    """Return the bars of which something is between two times."""
    return [bar for bar in bars if bar[0] <= end_s and bar[0] + bar[1] >= start_s]


def _bars(time: np.ndarray, stance: np.ndarray) -> list[Bar]:
    first, end = stance_bounds(stance).T
    starts, ends = time[first], time[np.minimum(end, len(time) - 1)]
    return list(zip(starts.tolist(), (ends - starts).tolist(), strict=True))
