"""Entries as rows of figures: flat for CSV, and summed up over the bags for people."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ..batch import Entry

Figure = float | None


def flat(entry: Entry) -> dict[str, Any]:
    """Return one row of plain figures; None where there is none."""
    figures = entry.to_dict()
    row: dict[str, Any] = {"bag": entry.bag, "case": entry.case.label, "method": figures["method"]}
    name, value = entry.case.swept or (None, None)
    row |= {"swept": name, "value": value}
    for column, path in COLUMNS.items():
        open_walk = path.startswith("closure.") and not figures["closed_loop"]
        row[column] = None if open_walk else _look_up(figures, path)
    for foot in ("left", "right"):
        for mark, error in (_look_up(figures, f"truth.{foot}.at_distance_m") or {}).items():
            row[f"{foot}_error_at_{mark}_m"] = error
    row |= stride_errors(entry)
    row["run_s"] = entry.run_s
    return row


COLUMNS = {
    "left_rmse_m": "truth.left.rmse_m",
    "right_rmse_m": "truth.right.rmse_m",
    "midpoint_rmse_m": "truth.midpoint.rmse_m",
    "left_end_m": "truth.left.end_m",
    "right_end_m": "truth.right.end_m",
    "midpoint_end_m": "truth.midpoint.end_m",
    "midpoint_end_percent": "truth.midpoint.end_percent",
    "common_heading_end_deg": "truth.heading.common_end_deg",
    "difference_heading_end_deg": "truth.heading.difference_end_deg",
    "left_marker_rmse_m": "markers.left.rmse_m",
    "right_marker_rmse_m": "markers.right.rmse_m",
    "closure_mean_m": "closure.mean_m",
    "closure_mean_percent": "closure.mean_percent",
    "closure_midpoint_m": "closure.midpoint_m",
    "left_stances": "stances.left",
    "right_stances": "stances.right",
    "feet_crossed_percent": "feet.crossed_percent",
    "distance_error_mean_m": "distance_error_at_minima_m.mean",
    "distance_error_rms_m": "distance_error_at_minima_m.rms",
    "distance_error_max_m": "distance_error_at_minima_m.max",
    "distance_error_std_m": "distance_error_at_minima_m.std",
    "constraints_applied": "events.constraint.applied",
    "constraints_refused": "events.constraint.refused",
    "relative_position_nees": "truth.nees.relative_position",
}


def _look_up(value: Any, path: str) -> Any:
    for key in path.split("."):
        if not isinstance(value, dict):
            return None
        value = value.get(key)
    return value


def stride_errors(entry: Entry) -> dict[str, Figure]:
    """Return the figures of one walk in Table I of Ma and Särkkä 2023."""
    place = entry.stride
    if place is None:
        return {}
    row: dict[str, Figure] = {"stride_y_right_minus_left_m": place.right[1] - place.left[1]}
    row["stride_right_x_m"], row["stride_right_y_m"] = place.right
    row["stride_left_x_m"], row["stride_left_y_m"] = place.left
    if place.true_right is not None and place.true_left is not None:
        row["stride_true_y_right_minus_left_m"] = place.true_right[1] - place.true_left[1]
        row["stride_right_x_error_m"] = place.right[0] - place.true_right[0]
        row["stride_right_y_error_m"] = place.right[1] - place.true_right[1]
        row["stride_left_x_error_m"] = place.left[0] - place.true_left[0]
    return row


def csv_text(rows: Sequence[dict[str, Any]]) -> str:
    """Return rows as CSV with one header; a column that any row has, every row has."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def values(rows: Iterable[dict[str, Any]], column: str) -> list[float]:
    """Return the figures of a column, without the rows that have none."""
    figures = (row.get(column) for row in rows)
    return [float(v) for v in figures if v is not None]


def over_bags(
    rows: Sequence[dict[str, Any]], column: str, how: Callable[[list[float]], Any] = np.median
) -> Figure:
    """Return a column summed up over the bags, by default its median."""
    figures = values(rows, column)
    return float(how(figures)) if figures else None


def by_case(rows: Iterable[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Return the rows by case, cases in the order of their first row."""
    cases: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        cases.setdefault(row["case"], []).append(row)
    return cases
