"""The columns behind the plots of one walk."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....core import FEET, FloatArray, picked, stance_bounds, swing_passings
from ...frames.association import Footfalls, seconds
from ...tracked_person import CHI2_95_PLANE, PersonTrack
from ...whole_evaluation import Evaluation, constraint_epochs
from .page_tables import table, thin

CENTI = 0.01


def walk_tables(run: Evaluation, person: PersonTrack) -> dict[str, Any]:
    """Return the tables "walk", "left", "right" (stances), "strides_...", "moments" of a run."""
    tables = {"walk": table(_walk(run, person), {"angle": 0.1})}
    time = seconds(run.trajectory.left.stamp_ns, int(run.trajectory.left.stamp_ns[0]))
    for foot, track in run.feet_tracks.items():
        bounds = stance_bounds(track.stance)
        ends = time[np.minimum(bounds[:, 1], len(time) - 1)]
        tables[foot] = table({"start": time[bounds[:, 0]], "end": ends})
        tables[f"strides_{foot}"] = _strides(run, foot)
        if foot in run.markers and run.aligned_to == "markers":
            points = run.markers[foot]
            tables[f"markers_{foot}"] = table({"x": points[:, 0], "y": points[:, 1]})
    tables["moments"] = _moments(run, time)
    return tables


def _walk(run: Evaluation, person: PersonTrack) -> dict[str, FloatArray]:
    rows = thin(len(person.stamp_ns))
    feet = run.trajectory.left, run.trajectory.right
    left, right = (picked(foot.position, rows) for foot in feet)
    both = feet[0].present[rows] & feet[1].present[rows]
    some = person.at(rows)
    longer, shorter, angle = some.axes
    columns = {
        "time": seconds(person.stamp_ns, int(person.stamp_ns[0]))[rows],
        "walked": some.walked_m,
        "x": some.position[:, 0],
        "y": some.position[:, 1],
        "floor": some.floor_m,
        "sigma_z": np.sqrt(np.maximum(some.covariance[:, 2, 2], 0.0)),
        "radius": some.radius_95_m,
        "major": np.sqrt(CHI2_95_PLANE * np.maximum(longer, 0.0)),
        "minor": np.sqrt(CHI2_95_PLANE * shorter),
        "angle": np.degrees(angle),
        "apart": np.where(both, np.linalg.norm(left - right, axis=1), np.nan),
    }
    for foot, points in zip(FEET, (left, right), strict=True):
        columns |= {f"{foot}_{axis}": points[:, i] for i, axis in enumerate("xyz")}
    return columns | _truth(run, rows, columns)


def _truth(
    run: Evaluation, rows: np.ndarray, columns: dict[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return the truth and the horizontal errors against it, where it is known."""
    if run.truth is None:
        return {}
    true: dict[str, FloatArray] = {}
    floors = []
    for foot, series, track in zip(FEET, run.truth, run.feet_tracks.values(), strict=True):
        points = series.position
        falls = Footfalls.of(track)
        floors.append(
            np.interp(rows, falls.middle, picked(points, falls.middle)[:, 2])
            if len(falls)
            else 0.0
        )
        some = picked(points, rows)
        true |= {f"true_{foot}_{axis}": some[:, i] for i, axis in enumerate("xy")}
        true[f"error_{foot}"] = np.hypot(
            *(columns[f"{foot}_{axis}"] - true[f"true_{foot}_{axis}"] for axis in "xy")
        )
    middle = [(true[f"true_left_{axis}"] + true[f"true_right_{axis}"]) / 2 for axis in "xy"]
    true["error"] = np.hypot(columns["x"] - middle[0], columns["y"] - middle[1])
    left, right = (picked(series.position, rows) for series in run.truth)
    true["true_apart"] = np.linalg.norm(left - right, axis=1)
    true["true_floor"] = np.mean(np.broadcast_arrays(*floors), axis=0) + np.zeros(len(rows))
    return true


def _strides(run: Evaluation, foot: str) -> Any:
    """Return the steady strides of a foot over the time of their middles."""
    start = int(run.trajectory.left.stamp_ns[0])
    own = [s for s in run.gait.strides if s.foot == foot and s.steady]
    return table(
        {
            "time": np.array([((s.start_ns + s.end_ns) // 2 - start) * 1e-9 for s in own]),
            "length": np.array([s.stride_length_m for s in own]),
            "speed": np.array([s.speed_m_per_s for s in own]),
        }
    )


def _moments(run: Evaluation, time: FloatArray) -> Any:
    """Return the moments of constraints, or of the passings where no constraint was applied."""
    left, right = run.trajectory.left, run.trajectory.right
    at = constraint_epochs(run.trajectory)
    if len(at) == 0:
        passed = swing_passings(left.position, right.position, left.stance, right.stance)
        at = passed.where(left.present & right.present).index
    at = at[thin(len(at), 2000)]
    columns = {
        "time": time[at],
        "apart": np.linalg.norm(picked(left.position, at) - picked(right.position, at), axis=1),
    }
    if run.truth is not None:
        left_true, right_true = (picked(series.position, at) for series in run.truth)
        columns["true_apart"] = np.linalg.norm(left_true - right_true, axis=1)
    return table(columns)
