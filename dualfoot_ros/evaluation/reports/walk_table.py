"""The figures of one walk as a table for people."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from ...core import FEET
from ..frames.association import Footfalls
from ..gait import PARAMETERS
from ..metrics.accuracy import Statistics
from ..whole_evaluation import Evaluation

if TYPE_CHECKING:
    from rich.table import Table

SHOWN_GAIT = {
    "stride_length_m": 2,
    "step_width_m": 2,
    "cadence_steps_per_min": 1,
    "speed_m_per_s": 2,
}
"""Gait parameters in the table, with their digits."""

MOST_MARKS = 5
"""Rows of "error at N m" on long walks; the files have all of them."""

Row = tuple[str, str, str, str]
COLUMNS = (
    "RMSE (m)",
    "end error (m)",
    "end error (%)",
    "heading error,\ncommon (deg)",
    "heading error,\ndifference (deg)",
    "feet\ncrossed (%)",
)


def walk_table(run: Evaluation, title: str) -> Table:
    """Return a table with columns left, right and both, and only the rows that are known."""
    from rich.table import Table

    table = Table(title=title, caption=f"aligned by: {run.alignment_name}", title_justify="left")
    for name, side in (
        ("", "left"),
        ("left", "right"),
        ("right", "right"),
        ("both feet", "right"),
    ):
        table.add_column(name, justify=side)  # type: ignore[arg-type]
    for section in sections(run):
        for row in section:
            table.add_row(*row)
        table.add_section()
    return table


def sections(run: Evaluation) -> list[list[Row]]:
    """Return the rows (name, left, right, both feet) of what is known, section by section."""
    parts = (_walk(run), _truth(run), _markers(run), _closure(run), _feet(run), _gait(run))
    return [rows for part in parts if (rows := list(part))]


def number(value: float | None, digits: int = 2) -> str:
    """Return a figure as text, a dash where there is none."""
    return "-" if value is None or math.isnan(value) else f"{value:z.{digits}f}"


def _walk(run: Evaluation) -> Iterator[Row]:
    tracks = run.feet_tracks.items()
    seen = [track if foot in run.tracked_feet else None for foot, track in tracks]
    stances = [str(len(Footfalls.of(track))) if track else "-" for track in seen]
    yield "stances", stances[0], stances[1], ""
    ways = [number(track.distance_m) if track else "-" for track in seen]
    yield "distance walked (m)", ways[0], ways[1], ""


def _truth(run: Evaluation) -> Iterator[Row]:
    report = run.truth_report
    if report is None:
        return
    sides = (report.left, report.right, report.midpoint)
    names = {
        "RMSE (m)": "rmse_m",
        "height RMSE (m)": "rmse_vertical_m",
        "largest error (m)": "max_m",
        "end error (m)": "end_m",
        "end error (% of distance)": "end_percent",
    }
    for label, name in names.items():
        left, right, middle = (number(getattr(s, name), 3) for s in sides)
        yield label, left, right, f"mid-point {middle}"
    for mark in _few(list(report.midpoint.at_distance_m)):
        errors = [number(s.at_distance_m.get(mark), 3) for s in sides]
        yield f"error at {mark} m (m)", errors[0], errors[1], f"mid-point {errors[2]}"
    strides = (report.left_strides, report.right_strides)
    yield "stride RMSE (m)", number(strides[0].rmse_m, 3), number(strides[1].rmse_m, 3), ""
    ratios = [number(s.length_ratio, 4) for s in strides]
    yield "stride length, estimate/truth", ratios[0], ratios[1], ""
    heading = report.heading
    ends = number(heading.left_end_deg), number(heading.right_end_deg)
    yield "heading error at the end (deg)", *ends, f"{heading.common_end_deg:.2f} common"
    yield "", "", "", f"{heading.difference_end_deg:.2f} difference"
    nees = report.nees
    positions = number(nees.left_position), number(nees.right_position)
    yield "NEES of position / 3", *positions, f"{number(nees.relative_position)} relative"


def _few(marks: list[str]) -> list[str]:
    """Return at most ``MOST_MARKS`` of the marks, evenly spaced: 800, 1600 ... of 200, 400 ..."""
    step = math.ceil(len(marks) / MOST_MARKS) or 1
    return marks[step - 1 :: step]


def _markers(run: Evaluation) -> Iterator[Row]:
    reports = [run.marker_report.get(foot) for foot in run.feet_tracks]
    if not any(reports):
        return
    counts = [f"{r.stances} for {r.markers}" if r else "" for r in reports]
    yield "stances for markers", counts[0], counts[1], ""
    for label, name in (
        ("marker RMSE (m)", "rmse_m"),
        ("largest marker error (m)", "max_m"),
        ("error at the last marker (m)", "end_m"),
    ):
        values = [number(getattr(r, name), 3) if r else "" for r in reports]
        yield label, values[0], values[1], ""


def _closure(run: Evaluation) -> Iterator[Row]:
    gap = run.closure
    if gap is None:
        return
    label = "loop closure" if run.closed_loop else "start to end"
    means = number(gap.mean_m, 3), number(gap.mean_percent)
    yield f"{label} (m)", number(gap.left_m, 3), number(gap.right_m, 3), f"mean {means[0]}"
    shares = number(gap.left_percent), number(gap.right_percent)
    yield f"{label} (% of distance)", *shares, f"mean {means[1]}"


def _feet(run: Evaluation) -> Iterator[Row]:
    feet = run.feet
    if feet.distance_m.count == 0:  # one foot alone, or no step
        return
    crossed = f"{number(feet.crossed_percent, 1)} ({feet.crossed} of {feet.passings})"
    yield "feet crossed (% of passings)", "", "", crossed
    moments = f"at {feet.distance_m.count} {feet.moments}s"
    yield from _spread(f"feet apart {moments}", feet.distance_m)
    if feet.distance_error_m is not None:
        yield from _spread("error of that", feet.distance_error_m)


def _spread(label: str, spread: Statistics) -> Iterator[Row]:
    both = f"{number(spread.mean, 3)} +- {number(spread.std, 3)}"
    yield f"{label}, mean +- std (m)", "", "", both
    yield "    RMS, max (m)", "", "", f"{number(spread.rms, 3)}, {number(spread.max, 3)}"


def _gait(run: Evaluation) -> Iterator[Row]:
    """Yield the parameters that everybody asks for; the others are in the files of a report."""
    counts = [run.gait.count(foot, steady=True) for foot in FEET]
    if sum(counts) == 0:
        return
    seen = [foot in run.tracked_feet for foot in FEET]
    shown = [str(n) if there else "-" for n, there in zip(counts, seen, strict=True)]
    yield "steady strides", shown[0], shown[1], ""
    for name, digits in SHOWN_GAIT.items():
        own = run.gait.parameters[name]
        feet = [
            f"{number(s.mean, digits)} +- {number(s.std, digits)}" if s.mean is not None else "-"
            for s in (own.left, own.right)
        ]
        yield PARAMETERS[name], feet[0], feet[1], number(own.both.mean, digits)


def methods_table(runs: Mapping[str, Evaluation], title: str) -> Table:
    """Return a table of runs that were evaluated against truth, both feet a block."""
    from rich.table import Table

    first = next(iter(runs.values()))
    caption = f"aligned by: {first.alignment_name}; headings at the end of the walk"
    table = Table(title=title, caption=caption, title_justify="left")
    table.add_column("method", no_wrap=True)  # the headings break before it
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
