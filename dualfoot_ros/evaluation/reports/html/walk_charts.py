"""The plots of one walk: what each shows, in which colour, over which columns."""

from __future__ import annotations

import math
from typing import Any

from ....core import FEET
from ...exports import start_direction
from ...tracked_person import PersonTrack
from ...whole_evaluation import Evaluation
from ..plots import FOOT, GREEN, MARKER, TRUTH

PERSON = "#4B3F8F"
LONG_WALK_M = 400.0
"""On longer walks the lines of the feet would cover each other, so they are hidden at first."""

TOLD = [
    ["time", "time (s)", 1],
    ["walked", "walked (m)", 1],
    ["x", "x (m)", 2],
    ["y", "y (m)", 2],
    ["floor", "height (m)", 2],
    ["radius", "95 % radius (m)", 2],
]


def walk_charts(run: Evaluation, person: PersonTrack) -> dict[str, dict[str, Any]]:
    """Return the plots by name, in the order in which they stand on the page."""
    moments = "constraint applied" if run.feet.moments == "constraint" else "feet pass"
    charts = {
        "map": _map(run, person),
        "height_time": _height(run, "time", "time since the start (s)"),
        "height_walked": _height(run, "walked", "distance walked (m)"),
        "uncertainty": _uncertainty(run),
        "apart": _apart(run, person, moments),
        "stances": _stances(run),
        "stride_length": _strides(run, "length", "Stride length", "m"),
        "speed": _strides(run, "speed", "Speed of each stride", "m/s"),
    }
    if len(run.tracked_feet) < len(FEET):
        del charts["apart"]
    told = TOLD + ([["error", "error (m)", 2]] if run.truth is not None else [])
    for chart in charts.values():
        chart["told"] = told
    return charts


def line(name: str, colour: str, x: str, y: str, **more: Any) -> dict[str, Any]:
    """Return one series over columns of the table "walk"."""
    return {"name": name, "color": colour, "table": "walk", "x": x, "y": y, **more}


def _map(run: Evaluation, person: PersonTrack) -> dict[str, Any]:
    long = float(person.walked_m[-1]) > LONG_WALK_M
    series = []
    if run.truth is not None:
        series += [
            line("truth", TRUTH, f"true_{foot}_x", f"true_{foot}_y", width=4, opacity=0.7)
            for foot in FEET
        ]
    series.append(line("95 % of the place", PERSON, "x", "y", style="ellipses"))
    series += [
        line(f"{foot} foot", FOOT[foot], f"{foot}_x", f"{foot}_y", width=1, shown=not long)
        for foot in run.tracked_feet
    ]
    series.append(line("person", PERSON, "x", "y", width=2))
    for foot in run.markers if run.aligned_to == "markers" else ():
        series.append(
            {
                **line("floor markers", MARKER, "x", "y", style="dots", hollow=True, width=5),
                "table": f"markers_{foot}",
            }
        )
    return {
        "title": "Track from above",
        "kind": "map",
        "x": "x (m)",
        "y": "y (m)",
        "link": "walk",
        "series": series,
        "marks": map_marks(person),
        "note": f"Aligned by: {run.alignment_name}. The arrow is the heading at the start; the "
        "shaded band holds the true place with 95 % as far as the filter knows.",
    }


def map_marks(person: PersonTrack) -> list[dict[str, Any]]:
    """Return start (with the heading of the first metres) and end."""
    first, last = person.position[0], person.position[-1]
    angle = math.degrees(start_direction(person))
    start = {"x": first[0], "y": first[1], "label": "start", "symbol": "arrow", "angle": angle}
    return [start, {"x": last[0], "y": last[1], "label": "end", "symbol": "cross"}]


def _height(run: Evaluation, over: str, label: str) -> dict[str, Any]:
    series = [line("± 2 sigma", PERSON, over, "floor", style="band", half="sigma_z", factor=2)]
    if run.truth is not None:
        series.append(line("true floor", TRUTH, over, "true_floor", width=4, opacity=0.7))
    series += [
        line(f"{foot} foot", FOOT[foot], over, f"{foot}_z", width=0.8, shown=False)
        for foot in run.tracked_feet
    ]
    series.append(line("where the feet stand", PERSON, over, "floor", width=2))
    zero = "Of the sensors, above their place at the start."
    if run.truth is not None:
        zero = "Of the sensors, so it begins with their height on the shoe."
    return {
        "title": "Height over time" if over == "time" else "Height over distance",
        "kind": "line",
        "group": over,
        "over": over,
        "x": label,
        "y": "height (m)",
        "least": 0.5,
        "link": "walk",
        "series": series,
        "note": f"{zero} Floors and stairs show as steps; the legend adds the feet with their "
        "swings.",
    }


def _uncertainty(run: Evaluation) -> dict[str, Any]:
    series = [line("95 % radius claimed", PERSON, "walked", "radius", dash="6 3")]
    if run.truth is not None:
        # Where all three agree they lie on each other: the wide ones first, so that each shows.
        series += [
            line(f"error of the {foot} foot", FOOT[foot], "walked", f"error_{foot}", width=width)
            for foot, width in zip(FEET, (4.5, 2.8), strict=True)
        ]
        series.append(line("error of the person", "#1b1b1b", "walked", "error", width=1.2))
    how = f" Aligned by: {run.alignment_name}." if run.truth is not None else ""
    title = "Uncertainty" if run.truth is None else "Error and uncertainty"
    return {
        "title": f"{title} over distance",
        "kind": "line",
        "group": "walked",
        "over": "walked",
        "x": "distance walked (m)",
        "y": "horizontal (m)",
        "zero": True,
        "least": 0.1,
        "link": "walk",
        "series": series,
        "note": f"The true place lies within the radius with 95 %, if the filter is right.{how}",
    }


def _apart(run: Evaluation, person: PersonTrack, moments: str) -> dict[str, Any]:
    short = float(person.walked_m[-1]) <= LONG_WALK_M
    series = []
    if run.truth is not None:
        true = line("truth", TRUTH, "time", "true_apart", width=3, opacity=0.7, shown=short)
        at_moments = line(
            f"truth, {moments}", TRUTH, "time", "true_apart", style="dots", width=2.5
        )
        series += [true, {**at_moments, "table": "moments"}]
    series.append(line("estimate", "#444444", "time", "apart", width=1, shown=short))
    series.append({**line(moments, GREEN, "time", "apart", style="dots"), "table": "moments"})
    return {
        "title": "Distance between the feet",
        "kind": "line",
        "group": "time",
        "over": "time",
        "x": "time since the start (s)",
        "y": "distance (m)",
        "zero": True,
        "link": "walk",
        "series": series,
        "note": "" if short else "The lines of so many steps fill the plot; the legend adds them.",
    }


def _stances(run: Evaluation) -> dict[str, Any]:
    bars = [
        {
            **line(f"{foot} foot stands", FOOT[foot], "start", "", style="bars", row=row),
            "table": foot,
            "end": "end",
        }
        for row, foot in enumerate(run.tracked_feet)
    ]
    return {
        "title": "Stance phases",
        "kind": "strips",
        "group": "time",
        "over": "time",
        "x": "time since the start (s)",
        "rows": list(run.tracked_feet),
        "link": "walk",
        "series": bars,
        "note": "Foot-flat phases, as the zero-velocity detector found them. Zoom in to see them.",
    }


def _strides(run: Evaluation, column: str, title: str, unit: str) -> dict[str, Any]:
    dots = [
        {
            **line(f"{foot} foot", FOOT[foot], "time", column, style="dots", width=2.5),
            "table": f"strides_{foot}",
        }
        for foot in run.tracked_feet
    ]
    return {
        "title": title,
        "kind": "line",
        "group": "time",
        "over": "time",
        "x": "time since the start (s)",
        "y": f"{column} ({unit})",
        "least": 0.2,
        "link": "walk",
        "series": dots,
        "note": "Steady strides only.",
    }
