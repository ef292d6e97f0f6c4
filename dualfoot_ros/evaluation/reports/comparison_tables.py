"""The tables of a comparison: one line a method, and the statistics as the papers print them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..metrics.repeated_walk import STRIDE
from .comparison_rows import by_case, over_bags, values
from .walk_table import number

if TYPE_CHECKING:
    from rich.table import Table

Rows = Sequence[Mapping[str, Any]]

OVERVIEW = (
    ("marker\nRMSE (m)", "right_marker_rmse_m", 3),
    ("RMSE\nmid (m)", "midpoint_rmse_m", 3),
    ("end error\nmid (m)", "midpoint_end_m", 3),
    ("end error\nmid (%)", "midpoint_end_percent", 2),
    ("closure\n(m)", "closure_mean_m", 3),
    ("closure\n(%)", "closure_mean_percent", 2),
    ("heading err.\ncommon (deg)", "common_heading_end_deg", 2),
    ("heading err.\ndiff. (deg)", "difference_heading_end_deg", 2),
    ("feet\ncrossed (%)", "feet_crossed_percent", 1),
    ("run time\n(s)", "run_s", 2),
)
SIGNED = ("common_heading_end_deg", "difference_heading_end_deg")
DISTANCE = ("mean", "rms", "max", "std")


def tables(rows: Sequence[dict[str, Any]]) -> Iterator[Table]:
    """Yield the tables that the rows have figures for."""
    bags = len({row["bag"] for row in rows})
    plain = [row for row in rows if row["swept"] is None]
    if plain:
        yield _overview(plain, bags)
        yield from _papers(plain, bags)
    for name in dict.fromkeys(row["swept"] for row in rows if row["swept"] is not None):
        swept = [row for row in rows if row["swept"] == name]
        yield _overview(swept, bags, f"{name} swept (as Liu et al. 2023, Tables V, VI)")
        yield from _marks(swept, bags)


def _papers(rows: Sequence[dict[str, Any]], bags: int) -> Iterator[Table]:
    yield from _marks(rows, bags)
    if values(rows, "distance_error_rms_m"):
        yield _distances(rows, bags)
    if values(rows, "stride_right_x_error_m"):
        yield _strides(rows, bags)


def _table(title: str, names: Sequence[str], caption: str | None = None) -> Table:
    from rich.table import Table

    table = Table(title=title, caption=caption, title_justify="left")
    table.add_column("method", no_wrap=True)
    for name in names:
        table.add_column(name, justify="right")
    return table


def _overview(rows: Sequence[dict[str, Any]], bags: int, title: str = "methods") -> Table:
    shown = [column for column in OVERVIEW if values(rows, column[1])]
    many = "; median (worst) over the bags" if bags > 1 else ""
    caption = f"{bags} bag{'s' * (bags > 1)}{many}; run time: CPU, sync and tracking"
    table = _table(title, [name for name, _, _ in shown], caption)
    for case, own in by_case(rows).items():
        table.add_row(case, *(_spread(own, name, digits) for _, name, digits in shown))
    return table


def _spread(rows: Sequence[dict[str, Any]], column: str, digits: int) -> str:
    figures = values(rows, column)
    if len(figures) < 2:
        return number(figures[0] if figures else None, digits)
    size = np.abs(figures) if column in SIGNED else np.array(figures)
    return f"{number(float(np.median(size)), digits)} ({number(float(size.max()), digits)})"


def _marks(rows: Sequence[dict[str, Any]], bags: int) -> Iterator[Table]:
    """Yield the error at 200, 400, ... m and at the end, by foot (Liu et al. 2023, Table III)."""
    marks = list(dict.fromkeys(_mark(c) for row in rows for c in row if "_error_at_" in c))
    if not marks:
        return
    title = "position error along the way (m), as Liu et al. 2023, Table III"
    names = ["foot", *(f"{mark} m" for mark in marks), "end"]
    table = _table(title, names, "median over the bags" if bags > 1 else None)
    for case, own in by_case(rows).items():
        for foot in ("left", "right"):
            columns = [f"{foot}_error_at_{mark}_m" for mark in marks] + [f"{foot}_end_m"]
            cells = [number(over_bags(own, column)) for column in columns]
            table.add_row(case if foot == "left" else "", foot, *cells)
        table.add_section()
    yield table


def _mark(column: str) -> str:
    return column.rpartition("_error_at_")[2].removesuffix("_m")


def _distances(rows: Sequence[dict[str, Any]], bags: int) -> Table:
    title = "distance of the feet where they pass, estimate - truth (m), as Liu et al., Table II"
    table = _table(title, ["Mean", "RMS", "MAX", "Std"], "median over the bags" * (bags > 1))
    for case, own in by_case(rows).items():
        cells = [number(over_bags(own, f"distance_error_{name}_m"), 3) for name in DISTANCE]
        table.add_row(case, *cells)
    return table


def _strides(rows: Sequence[dict[str, Any]], bags: int) -> Table:
    title = f"stride {STRIDE}, as Ma and Särkkä 2023, Table I (m)"
    names = [
        "y_R - y_L",
        "true",
        "x_R - x_R,true",
        "x_L - x_L,true",
        "std x_R",
        "std y_R",
        "walks",
    ]
    caption = f"means over {bags} bag{'s' * (bags > 1)}; y along the first strides, x to the right"
    table = _table(title, names, caption)
    columns = (
        ("stride_y_right_minus_left_m", np.mean),
        ("stride_true_y_right_minus_left_m", np.mean),
        ("stride_right_x_error_m", np.mean),
        ("stride_left_x_error_m", np.mean),
        ("stride_right_y_error_m", np.mean),
        ("stride_right_x_m", np.std),
        ("stride_right_y_m", np.std),
    )
    for case, own in by_case(rows).items():
        known = [row for row in own if row.get("stride_right_x_error_m") is not None]
        cells = [number(over_bags(known, name, how)) for name, how in columns]
        table.add_row(case, *cells, f"{len(known)} of {len(own)}")
    return table
