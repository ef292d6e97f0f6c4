"""``report.html`` of a comparison: the tables, and every track of a bag in one plot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ....core import TrackerConfig
from ..comparison_rows import by_case, over_bags
from ..plots import MARKER, TRUTH
from ..walk_table import number
from .comparison_words import JUDGED, in_words, ranking
from .page import figure, html_table, page, section, words
from .page_tables import table
from .walk_page import FILE_NAME
from .words import Sentence, Tone

if TYPE_CHECKING:
    from ...batch import Entry

COLOURS = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#4B3F8F", "#E69F00", "#56B4E9", "#7F3C1D",
    "#3D7A1F", "#B01E5B", "#5C5C5C", "#1B1B1B",
)  # fmt: skip
WIDTHS = (9.0, 6.0, 3.5, 1.5)
"""Tracks that agree lie on each other: the wide ones first, so that each shows."""

TRUTH_STYLE = {"color": TRUTH, "width": 14, "opacity": 0.4}
MARKER_STYLE = {"color": MARKER, "style": "dots", "hollow": True, "width": 5}
HIDDEN_WIDTH = 2.0
BASELINE = "zupt"
FIGURES = {
    "midpoint_rmse_m": ("RMSE (m)", 3),
    "midpoint_end_m": ("end error (m)", 3),
    "midpoint_end_percent": ("end error (%)", 2),
    "right_marker_rmse_m": ("marker RMSE (m)", 3),
    "closure_mean_m": ("closure (m)", 3),
    "closure_mean_percent": ("closure (%)", 2),
    "common_heading_end_deg": ("heading, common (deg)", 2),
    "difference_heading_end_deg": ("heading, difference (deg)", 2),
    "feet_crossed_percent": ("feet crossed (%)", 1),
    "run_s": ("run time (s)", 2),
}


def write_comparison_page(
    directory: Path,
    entries: Sequence[Entry],
    rows: Sequence[Mapping[str, Any]],
    failures: Mapping[str, str],
) -> Path:
    """Write ``report.html`` of a comparison into ``directory`` and return its path.

    Parameters
    ----------
    entries : the runs
    rows : their figures, one flat row each, in the same order
    failures : name of a run -> why it gave no figures
    """
    path = directory / FILE_NAME
    path.write_text(comparison_page(entries, rows, failures), encoding="utf-8")
    return path


def comparison_page(
    entries: Sequence[Entry], rows: Sequence[Mapping[str, Any]], failures: Mapping[str, str]
) -> str:
    """Return the page; see :func:`write_comparison_page`."""
    bags = list(dict.fromkeys(entry.bag for entry in entries))
    cases = by_case([dict(row) for row in rows])
    shown = _shown(cases)
    tables: dict[str, Any] = {}
    charts: dict[str, Any] = {}
    for index, bag in enumerate(bags):
        own = [entry for entry in entries if entry.bag == bag]
        made, series = _tracks(index, own, shown)
        tables |= made
        charts[f"map{index}"] = _map(index, bag, own, series)
    body = [
        section("Findings", words([*_warnings(entries), *in_words(cases, failures)])),
        section("Figures", _table(cases), _caption(entries, len(bags))),
        section("Tracks", *(figure(name) for name in charts)),
    ]
    about = f"{len(cases)} methods or settings on {len(bags)} recording{'s' * (len(bags) > 1)}"
    return page("Comparison of methods", about, body, {"tables": tables, "charts": charts})


def _warnings(entries: Sequence[Entry]) -> list[Sentence]:
    """Return what is wrong with the samples of the recordings, each once."""
    found = dict.fromkeys(f"{entry.bag}: {each}." for entry in entries for each in entry.warnings)
    return [Sentence(text, Tone.WARNING) for text in found]


def _known(cases: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Return the figures that any case has."""
    return [
        name
        for name in FIGURES
        if any(over_bags(rows, name) is not None for rows in cases.values())
    ]


def _table(cases: Mapping[str, list[dict[str, Any]]]) -> str:
    shown = _known(cases)
    rows = [
        [case, *(number(over_bags(own, name), FIGURES[name][1]) for name in shown)]
        for case, own in cases.items()
    ]
    return html_table(["method", *(FIGURES[name][0] for name in shown)], [rows])


def _caption(entries: Sequence[Entry], bags: int) -> str:
    median = "Medians over the recordings. " if bags > 1 else ""
    how = "; ".join(dict.fromkeys(entry.metrics["alignment"]["words"] for entry in entries))
    return f'<p class="soft">{median}Of the point between the feet. Aligned by: {how}.</p>'


def _shown(cases: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Return the cases whose tracks are shown at first: baseline, worst, best and the default."""
    orders = (ranking(cases, figure) for figure in JUDGED)
    order = [case for _, case in next((found for found in orders if found), [])]
    wanted = [BASELINE, *order[-1:], *order[:1], TrackerConfig().method, *cases]
    known = [case for case in dict.fromkeys(wanted) if case in cases]
    return known[: len(WIDTHS)]


def _tracks(
    index: int, entries: Sequence[Entry], shown: Sequence[str]
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Return the tables and the series of all tracks of one bag: truth below, markers on top."""
    first = entries[0].tracks
    curves = [("truth", points, TRUTH_STYLE) for points in first.truth.values()]
    styles = {e.case.label: _style(k, e.case.label, shown) for k, e in enumerate(entries)}
    for entry in sorted(entries, key=lambda entry: -styles[entry.case.label]["width"]):
        person = np.mean(list(entry.tracks.estimate.values()), axis=0)
        curves.append((entry.case.label, person, styles[entry.case.label]))
    curves += [("floor markers", points, MARKER_STYLE) for points in first.markers.values()]
    names = [f"{index}.{number_}" for number_ in range(len(curves))]
    tables = {
        name: table({"x": points[:, 0], "y": points[:, 1]})
        for name, (_, points, _) in zip(names, curves, strict=True)
    }
    series = [
        {"name": label, "table": name, "x": "x", "y": "y", **style}
        for name, (label, _, style) in zip(names, curves, strict=True)
    ]
    return tables, series


def _style(number_: int, label: str, shown: Sequence[str]) -> dict[str, Any]:
    """Return colour and dash of the track of a case by its number, and its width by its rank."""
    return {
        "color": COLOURS[number_ % len(COLOURS)],
        "dash": "" if number_ < len(COLOURS) else "5 3",
        "width": WIDTHS[shown.index(label)] if label in shown else HIDDEN_WIDTH,
        "shown": label in shown,
    }


def _map(
    index: int, bag: str, entries: Sequence[Entry], series: list[dict[str, Any]]
) -> dict[str, Any]:
    start = np.mean([points[0] for points in entries[0].tracks.estimate.values()], axis=0)
    return {
        "id": f"map-{index}",
        "title": Path(bag).name,
        "kind": "map",
        "x": "x (m)",
        "y": "y (m)",
        "series": series,
        "marks": [{"x": start[0], "y": start[1], "label": "start", "symbol": "dot"}],
        "note": "The point between the feet, from above; click names in the legend to show or "
        f"hide a track. Aligned by: {entries[0].metrics['alignment']['words']}.",
    }
