"""Which foot is on the left, and how far: from unconstrained tracks, and never a false alarm."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import StanceEpochs, StancePassing, stance_passings
from dualfoot_ros.inspection import side_by_side, walk_findings
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import SensorConfig, WalkConfig, rigid_pair, simulate, walk

from .tracks import track_feet


def passings(headings, spacing, *, drift=0.0, scale=0.0, offset=(0.0, 0.0), noise=0.0, seed=0):
    """Return the passings of a walk by formula: a step of 0.7 m at each heading (rad).

    The tracks differ in heading by ``drift`` (rad), in length by ``scale``, and start ``offset``.
    """
    rng = np.random.default_rng(seed)
    place, apart, made = np.zeros(2), np.array(offset, dtype=float), []
    for k, heading in enumerate(headings):
        forward = np.array([math.cos(heading), math.sin(heading)])
        left = np.array([-forward[1], forward[0]])
        way = 0.7 * forward
        place = place + way
        apart = apart + drift * np.array([-way[1], way[0]]) + scale * way
        separation = apart + spacing * left + noise * rng.standard_normal(2)
        stance = StanceEpochs(60 * k, 60 * k + 30)
        made.append(StancePassing(60 * k + 15, k % 2, stance, (0, 0), separation, forward, place))
    return made


EIGHT = np.radians(np.concatenate([np.linspace(0, 360, 40), np.linspace(360, 0, 40)]))


@settings(max_examples=30, deadline=None)
@given(
    spacing=st.floats(-0.3, 0.3),
    drift=st.floats(-0.05, 0.05),
    scale=st.floats(-0.02, 0.02),
    offset=st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3)),
)
def test_a_figure_of_eight_tells_the_spacing_whatever_the_tracks_do(spacing, drift, scale, offset):
    found = side_by_side(passings(EIGHT, spacing, drift=drift, scale=scale, offset=offset))
    assert found.spacing_m == pytest.approx(spacing, abs=0.03)
    assert found.std_m < 0.03
    assert found.turned_rad == pytest.approx(2 * math.pi, abs=1e-6)


def test_a_straight_line_tells_nothing_and_says_so():
    found = side_by_side(passings(np.zeros(80), 0.15))
    assert found.std_m > 0.15
    assert abs(found.sigmas) < 1.0


@settings(max_examples=20, deadline=None)
@given(turned=st.floats(-3.0, 3.0), seed=st.integers(0, 1000))
def test_in_which_direction_the_walk_starts_does_not_matter(turned, seed):
    made = passings(EIGHT, 0.15, noise=0.03, seed=seed)
    c, s = math.cos(turned), math.sin(turned)
    rotation = np.array([[c, -s], [s, c]])
    rotated = [
        p._replace(
            separation=rotation @ p.separation,
            forward=rotation @ p.forward,
            middle=rotation @ p.middle,
        )
        for p in made
    ]
    here, there = side_by_side(made), side_by_side(rotated)
    assert there.spacing_m == pytest.approx(here.spacing_m, abs=1e-9)
    assert there.std_m == pytest.approx(here.std_m, abs=1e-9)


def test_exchanging_the_feet_changes_the_sign_and_nothing_else():
    made = passings(EIGHT, 0.15, noise=0.03, drift=0.01)
    other = [p._replace(separation=-p.separation, standing=1 - p.standing) for p in made]
    here, there = side_by_side(made), side_by_side(other)
    assert there.spacing_m == pytest.approx(-here.spacing_m, abs=1e-12)
    assert there.std_m == pytest.approx(here.std_m, abs=1e-12)


def test_a_jump_of_a_track_is_a_new_placement_and_no_spacing():
    made = passings(EIGHT, 0.15)
    jumped = [
        p._replace(separation=p.separation + (np.array([2.0, -3.0]) if k >= 20 else 0.0))
        for k, p in enumerate(made)
    ]
    found = side_by_side(jumped)
    assert found.jumps == 1
    assert found.spacing_m == pytest.approx(0.15, abs=0.03)


def test_tracks_that_have_turned_apart_are_not_believed_any_more():
    found = side_by_side(passings(np.tile(EIGHT, 5), 0.15, drift=0.8))
    assert found.passings < 400


def test_the_scatter_is_that_of_the_steps():
    found = side_by_side(passings(np.zeros(400), 0.15, noise=0.02, drift=0.05))
    assert found.scatter_m == pytest.approx(0.02, rel=0.2)


@cache
def walked(route, seed):
    return walk(WalkConfig(route=route, rate=60.0), seed)


@pytest.mark.parametrize("errors", ["independent", "mirrored"])
@pytest.mark.parametrize("route", ["rectangle", "figure_eight", "L"])
def test_the_uncertainty_is_honest_on_simulated_walks(route, errors):
    sigmas = []
    for seed in range(3):
        made = simulate(walked(route, seed), SensorConfig(errors=errors), seed=seed)
        found = spacing_of(made.left, made.right)
        sigmas.append((found.spacing_m - 0.145) / found.std_m)
    assert np.abs(sigmas).max() < 3.0


def spacing_of(left, right):
    return side_by_side(stance_passings(track_feet(left, right)))


def walks(dual_feet):
    """Return the 27 synchronised walks of the data set."""
    folders = ("rectangle_ccw", "rectangle_cw", "figure_eight", "running_track")
    paths = [p for folder in folders for p in sorted((dual_feet / folder).glob("*.mat"))]
    return [import_recording(ImportOptions(sources=(path,))) for path in paths]


def test_of_the_real_walks_all_but_the_laps_show_exchanged_feet_and_none_a_false_alarm(dual_feet):
    recordings = walks(dual_feet)
    assert len(recordings) == 27
    alarms, recognised = 0, 0
    for recording in recordings:
        alarms += len(list(walk_findings(track_feet(recording.left, recording.right))))
        found = list(walk_findings(track_feet(recording.right, recording.left)))
        recognised += [finding.kind for finding in found] == ["swapped"]
    assert (recognised, alarms) == (25, 0)


def test_two_sensors_on_one_shoe_are_no_exchanged_feet():
    made = simulate(rigid_pair(walk(WalkConfig(route="L"), 1), 0.014), seed=1)
    assert list(walk_findings(track_feet(made.left, made.right))) == []
