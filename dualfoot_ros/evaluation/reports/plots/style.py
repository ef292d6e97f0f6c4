"""The style of all figures: colours that colour-blind readers distinguish, sizes, file type."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's palette.  The live page, RViz and Foxglove have the same colours of the feet.
FOOT = {"left": "#D55E00", "right": "#0072B2"}
TRUTH = "#A8A8A8"
MARKER = "#000000"
GREEN = "#009E73"
PINK = "#CC79A7"
COLUMNS_AN_INCH = 11
"""Letters of a title of the usual size."""

MOST_POINTS = 20_000
"""Of a line: many times the pixels of a figure."""

LINES = ("-", "--", ":", "-.")


def new_figure(width: float, height: float, rows: int = 1, columns: int = 1, **kwargs: Any) -> Any:
    """Return a figure of its own (no pyplot state) and its (rows, columns) axes."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=130, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **kwargs)
    for axis in axes.flat:
        tidy(axis)
    return figure, axes


def tidy(axis: Axes) -> None:
    """Remove the frame on two sides and lay a thin grid behind the data."""
    axis.spines[["top", "right"]].set_visible(False)
    axis.grid(visible=True, color="#E4E4E4", linewidth=0.6)
    axis.set_axisbelow(True)


def wrapped(heading: str, remark: str, width_in: float) -> str:
    """Return a heading and a remark below it, broken to a figure ``width_in`` inches wide."""
    columns = max(30, int(width_in * COLUMNS_AN_INCH))
    return "\n".join([*textwrap.wrap(heading, columns), *textwrap.wrap(remark, columns)])


def legend_above(axis: Axes, columns: int = 4) -> None:
    """Put the legend above the axes, where it hides no line.

    The place "best" would be searched for among all points: minutes on a walk of an hour.
    """
    axis.legend(
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        borderaxespad=0.2,
        ncols=columns,
        fontsize=8,
        frameon=False,
    )


def thinned(count: int) -> slice:
    """Return which of so many points of a line are drawn: all, or every k-th of a long walk."""
    return slice(None, None, max(1, count // MOST_POINTS))


def save(figure: Figure, path: Path) -> Path:
    """Write a figure as PNG and return the path.

    The layout is solved twice where an axis has a fixed aspect: solved once, for axes that shrink
    only after it, it lays titles and legends over each other.  ``Figure.savefig``, and to solve it
    by ``draw_without_rendering``, would draw every figure one more time, to the same pixels.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    engine = figure.get_layout_engine()
    if engine is not None and any(axis.get_aspect() != "auto" for axis in figure.axes):
        engine.execute(figure)
        for axis in figure.axes:
            axis.apply_aspect()
    FigureCanvasAgg(figure).print_png(path)  # type: ignore[no-untyped-call]
    return path
