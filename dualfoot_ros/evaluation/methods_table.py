"""Several methods on one walk, one block of rows a method."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .evaluate import Evaluation
from .reports.walk_table import number

if TYPE_CHECKING:
    from rich.table import Table

COLUMNS = (
    "RMSE (m)",
    "end error (m)",
    "end error (%)",
    "heading error,\ncommon (deg)",
    "heading error,\ndifference (deg)",
    "feet\ncrossed (%)",
)


def methods_table(runs: Mapping[str, Evaluation], title: str) -> Table:
    """Return a table of runs that were evaluated against truth, both feet a block."""
    from rich.table import Table

    first = next(iter(runs.values()))
    caption = f"aligned by: {first.alignment_name}; headings at the end of the walk"
    table = Table(title=title, caption=caption, title_justify="left")
    table.add_column("method")
    table.add_column("foot")
    for name in COLUMNS:
        table.add_column(name, justify="right")
    for name, run in runs.items():
        for row in _block(name, run):
            table.add_row(*row)
        table.add_section()
    return table


def _block(name: str, run: Evaluation) -> list[tuple[str, ...]]:
    report = run.truth_report
    if report is None:
        return [(name, "", *["-"] * len(COLUMNS))]
    shared = (
        number(report.heading.common_end_deg),
        number(report.heading.difference_end_deg),
        number(run.feet.crossed_percent, 1),
    )
    feet = [
        (number(errors.rmse_m, 3), number(errors.end_m, 3), number(errors.end_percent))
        for errors in (report.left, report.right)
    ]
    return [(name, "left", *feet[0], *shared), ("", "right", *feet[1], "", "", "")]
