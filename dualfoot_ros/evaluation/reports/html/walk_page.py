"""``report.html`` of one walk: of one method, or of several on the same recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ....core import EventKind
from ...exports import FloorPlan, GeoOrigin
from ...gait import PARAMETERS
from ...tracked_person import PersonTrack
from ...whole_evaluation import Evaluation
from ..walk_table import number, sections
from .page import figure, folded, html_table, page, section, tiles, words
from .walk_charts import walk_charts
from .walk_tables import walk_tables
from .words import clock, in_words

FILE_NAME = "report.html"
MOST_EVENTS = 500
FIRST_YEAR = 2000
"""Stamps from before it count from when a device was switched on."""

SHARES = ("vari\u00adability (%)", "sym\u00admetry (%)")
"""Headings with the places where a phone may break them."""

SHOWN_EVENTS = (
    EventKind.ALIGNED,
    EventKind.HEADING,
    EventKind.CONSTRAINT,
    EventKind.AID,
    EventKind.RESET,
)


def write_walk_page(
    directory: Path,
    runs: Mapping[str, Evaluation],
    title: str,
    parameters: Mapping[str, Any] | None = None,
    floor_plan: FloorPlan | None = None,
    origin: GeoOrigin | None = None,
) -> Path:
    """Write ``report.html`` into ``directory`` and return its path.

    Parameters
    ----------
    runs : name -> evaluation of the same recording, one for each method
    title : of the page, such as the name of the recording
    parameters : of the tracker by dotted name, for the end of the page
    floor_plan : picture under the track
    origin : of the walk on the Earth, for an arrow to the north
    """
    path = directory / FILE_NAME
    text = walk_page(runs, title, parameters, floor_plan, origin)
    path.write_text(text, encoding="utf-8")
    return path


def walk_page(
    runs: Mapping[str, Evaluation],
    title: str,
    parameters: Mapping[str, Any] | None = None,
    floor_plan: FloorPlan | None = None,
    origin: GeoOrigin | None = None,
) -> str:
    """Return the page; see :func:`write_walk_page`."""
    tables: dict[str, Any] = {}
    charts: dict[str, Any] = {}
    body: list[str] = []
    for index, (name, run) in enumerate(runs.items()):
        person = run.person
        own = _prefixed(index, walk_tables(run, person), walk_charts(run, person))
        if floor_plan is not None:
            own[1][f"{index}.map"]["picture"] = floor_plan.picture(person)
        if origin is not None:
            own[1][f"{index}.map"]["north"] = origin.north(person)
        tables |= own[0]
        charts |= own[1]
        body += _run_sections(run, person, list(own[1]), name if len(runs) > 1 else "")
    if parameters:
        body.append(_parameters(parameters))
    return page(
        title, _about(next(iter(runs.values()))), body, {"tables": tables, "charts": charts}
    )


def _about(run: Evaluation) -> str:
    start = datetime.fromtimestamp(run.trajectory.start_ns * 1e-9, UTC)
    if start.year < FIRST_YEAR:
        return "A walk stamped by the clock of the sensors, tracked by dualfoot_ros"
    return f"Walk of {start:%Y-%m-%d %H:%M:%S} UTC, tracked by dualfoot_ros"


def _prefixed(
    index: int, tables: Mapping[str, Any], charts: Mapping[str, Any]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return tables and charts under names of their own, so that several runs share a page."""
    moved = {}
    for name, chart in charts.items():
        series = [{**one, "table": f"{index}.{one['table']}"} for one in chart["series"]]
        linked = {"series": series, "link": f"{index}.{chart['link']}", "id": f"{index}-{name}"}
        moved[f"{index}.{name}"] = {**chart, **linked}
    return {f"{index}.{name}": one for name, one in tables.items()}, moved


def _run_sections(
    run: Evaluation, person: PersonTrack, plots: Sequence[str], name: str
) -> Iterator[str]:
    of = f" of {name}" if name else ""
    track, *others = plots
    yield section(f"Findings{of}", words(in_words(run, person)), tiles(_tiles(run, person)))
    yield section(f"Track{of}", figure(track))
    yield section(f"Plots{of}", *(figure(plot) for plot in others))
    yield section(f"Gait{of}", _gait_table(run), _gait_words(run))
    parts = [[[cell.replace("+-", "±") for cell in row] for row in part] for part in sections(run)]
    rows = html_table(["", "left", "right", "both feet"], parts)
    yield section(f"Figures{of}", rows, f'<p class="soft">Aligned by: {run.alignment_name}.</p>')
    yield section(f"Events{of}", _events(run))


def _tiles(run: Evaluation, person: PersonTrack) -> dict[str, str]:
    figures = {"distance walked": f"{person.walked_m[-1]:.1f} m"}
    if run.truth_report is not None:
        end = run.truth_report.midpoint
        figures["error at the end"] = f"{number(end.end_m)} m"
        figures["error at the end, of the way"] = f"{number(end.end_percent)} %"
    elif run.closure is not None:
        name = "loop closure" if run.closed_loop else "start to end"
        figures[name] = f"{number(run.closure.mean_m)} m"
    radius = float(person.at(slice(-1, None)).radius_95_m[-1])
    figures["95 % radius at the end, claimed"] = f"{radius:.2f} m"
    figures["height at the end"] = f"{person.floor_m[-1] - person.floor_m[0]:+.2f} m"
    figures["time"] = clock(person)
    speed = run.gait.parameters["speed_m_per_s"].both.mean
    figures["speed of steady walking"] = f"{number(speed)} m/s"
    return figures


def _gait_table(run: Evaluation) -> str:
    header = ["", "left", "±", "right", "±", "both", *SHARES]
    rows = []
    for name, label in PARAMETERS.items():
        own = run.gait.parameters[name]
        digits = 1 if name.endswith(("deg", "percent", "min")) else 3
        cells = [number(v, digits) for s in (own.left, own.right) for v in (s.mean, s.std)]
        shares = own.both.cv_percent, own.symmetry_percent
        both = number(own.both.mean, digits)
        rows.append([label, *cells, both, *(number(v, 1) for v in shares)])
    return html_table(header, [rows])


def _gait_words(run: Evaluation) -> str:
    counts = [str(run.gait.count(foot, steady=True)) for foot in run.tracked_feet]
    return (
        f'<p class="soft">Over {" and ".join(counts)} steady strides: not the first or last '
        "of a bout, straight and level. ± is the standard deviation from stride to stride, "
        "variability its share of the mean, symmetry (right - left) / mean.</p>"
    )


def _events(run: Evaluation) -> str:
    start = int(run.trajectory.left.stamp_ns[0])
    rows = [
        [
            f"{(event.stamp_ns - start) * 1e-9:.2f}",
            event.kind.value,
            event.foot,
            "applied" if event.accepted else f"not applied ({event.reason or 'gate'})",
            number(event.nis),
        ]
        for event in run.trajectory.events
        if event.kind in SHOWN_EVENTS
    ]
    table = html_table(
        ["time (s)", "event", "foot", "", "NIS"], [rows[:MOST_EVENTS]], text_columns=4
    )
    part = f", the first {MOST_EVENTS}" if len(rows) > MOST_EVENTS else ""
    return folded(f"{len(rows)} events besides stances and zero-velocity updates{part}", table)


def _parameters(parameters: Mapping[str, Any]) -> str:
    rows = [[name, str(value)] for name, value in parameters.items()]
    content = html_table(["parameter", "value"], [rows], text_columns=2)
    return section("Parameters", folded(f"{len(rows)} parameters of the tracker", content))
