"""Golden tracks: the positions of recorded walks do not change without somebody saying why."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "scripts" / "golden_tracks.py"
TOLERANCE_M = 1e-9
ADVICE = (
    "the track of {name} with {method} differs from test/golden/{file} by {difference:.3g} m at "
    "most (allowed is 1e-9 m); if that is meant, renew the golden tracks with 'make golden' and "
    "say in the commit why they have changed"
)


def load():
    """Import the script that makes the golden tracks."""
    spec = importlib.util.spec_from_file_location("golden_tracks", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


golden = load()


def largest_difference(made: np.ndarray, kept: np.ndarray) -> float:
    """Return the largest difference of two tracks (N, 7) in s or m; infinite for other lengths."""
    return float(np.abs(made - kept).max()) if made.shape == kept.shape else float("inf")


@pytest.mark.parametrize("method", golden.METHODS)
@pytest.mark.parametrize("name", [golden.BAG, *golden.WALKS])
def test_a_recorded_walk_has_the_track_that_is_kept(name, method):
    file = golden.track_file(name, method)
    kept, made = np.loadtxt(file, delimiter=","), golden.track(name, method)
    difference = largest_difference(made, kept)
    assert difference <= TOLERANCE_M, ADVICE.format(
        name=name, method=method, file=file.name, difference=difference
    )


def test_a_change_of_a_few_nanometres_is_seen():
    kept = np.loadtxt(golden.track_file(golden.BAG, "zupt"), delimiter=",")
    moved = kept.copy()
    moved[-1, 3] += 3e-9
    assert largest_difference(moved, kept) > TOLERANCE_M
    assert largest_difference(moved[:-1], kept) > TOLERANCE_M


def test_the_kept_walks_have_what_they_are_kept_for():
    walks = {name: golden.read_walk(name) for name in golden.WALKS}
    assert {round(left.rate_hz) for left, _ in walks.values()} == {60, 100}
    left, right = walks["clocks_gaps_pause"]
    offset_s = (left.stamp_ns[0] - right.stamp_ns[0]) * 1e-9
    assert 0.0 < abs(offset_s) < 0.01
    for series in (left, right):
        steps = np.diff(series.stamp_ns)
        assert (steps > 1.5 * np.median(steps)).sum() >= 10
    for name in golden.WALKS:
        times = np.loadtxt(golden.track_file(name, "idc"), delimiter=",")[:, 0]
        assert times[-1] > 30.0
