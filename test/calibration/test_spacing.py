"""The feet in passing: c0, kappa, step width; what a straight walk cannot tell; exchanged feet."""

import math

import numpy as np
import pytest
from inspection.tracks import track_feet

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.parameter_text import parameter_text
from dualfoot_ros.calibration.spacing import fit_spacing
from dualfoot_ros.core import DualFootTracker, TrackerConfig
from dualfoot_ros.core.results.events import EventKind
from dualfoot_ros.settings.presets import load_config
from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import align


def fitted(seed=1, exchanged=False, **route):
    """Return the walk that was simulated, its tracks, and what they tell."""
    made = simulate(WalkConfig(**route), seed=seed)
    feet = (made.right, made.left) if exchanged else (made.left, made.right)
    tracks = track_feet(*feet)
    return made, tracks, fit_spacing(tracks)


def truth_at(made, tracks):
    """Return the true positions of both feet at the epochs of the tracks."""
    return [
        np.column_stack([np.interp(tracks.left.stamp_ns, t.stamp_ns, p) for p in t.position.T])
        for t in (made.left_truth, made.right_truth)
    ]


def true_kappa(made, tracks, fit):
    """Return where in the stances of the detector the feet truly are closest, in the median."""
    left, right = truth_at(made, tracks)
    distance = np.linalg.norm(left - right, axis=1)
    rate_hz = tracks.left.stamp_ns.size / made.left_truth.stamp_ns.size * made.walk.config.rate
    lag = 0.5 * (max(2, round(0.05 * rate_hz)) - 1)
    shares = []
    for p in fit.passings:
        closest = p.swing[0] + int(np.argmin(distance[slice(*p.swing)]))
        shares.append((closest + lag - p.stance.first) / (p.stance.last - p.stance.first))
    return float(np.median(shares))


@pytest.fixture(scope="module")
def eight():
    """Return a figure of eight and what it tells."""
    return fitted(route="figure_eight")


def test_a_walk_with_turns_tells_distance_moment_and_height(eight):
    made, tracks, fit = eight
    assert fit.seen
    assert fit.c0_m == pytest.approx(float(np.mean(made.walk.passes.distance)), abs=0.03)
    assert fit.kappa == pytest.approx(true_kappa(made, tracks, fit), abs=0.02)
    assert 0.0 < fit.height_m < 0.1


def test_the_step_width_is_the_lateral_distance_of_the_footprints(eight):
    made, tracks, fit = eight
    truth = truth_at(made, tracks)
    widths = []
    for p in fit.passings:
        stand, swing = truth[p.standing], truth[1 - p.standing]
        begin, end = (swing[e, :2] for e in p.swing)
        way = (end - begin) / np.linalg.norm(end - begin)
        apart = stand[p.epoch, :2] - begin
        across = way[0] * apart[1] - way[1] * apart[0]
        widths.append(across if p.standing == 0 else -across)
    assert fit.step_width_m == pytest.approx(float(np.median(widths)), abs=0.03)


def test_a_straight_walk_tells_the_moment_but_not_the_distance():
    made, tracks, fit = fitted(route="straight")
    assert not fit.seen
    assert not fit.swapped
    assert fit.kappa == pytest.approx(true_kappa(made, tracks, fit), abs=0.02)
    names = {name.rpartition(".")[2] for name in fit.parameters()}
    assert names == {"kappa"}


@pytest.mark.parametrize("seed", [2, 3])
def test_exchanged_feet_are_recognised_in_turns(seed):
    *_, right = fitted(seed, route="figure_eight")
    *_, wrong = fitted(seed, True, route="figure_eight")
    assert not right.swapped
    assert wrong.swapped
    assert wrong.feet.spacing_m == pytest.approx(-right.feet.spacing_m, abs=5e-3)


def test_on_a_straight_line_exchanged_feet_cannot_be_told_and_are_not():
    *_, fit = fitted(exchanged=True, route="straight")
    assert not fit.swapped


def test_the_parameters_are_a_file_that_every_method_takes(eight, tmp_path):
    _, _, fit = eight
    path = tmp_path / "gait.yaml"
    path.write_text(parameter_text(fit.parameters(), ["measured"]))
    config = load_config(path, {"method": "idc"})
    assert config.constraint.distance == pytest.approx(fit.c0_m, abs=1e-4)
    assert config.constraint.kappa == pytest.approx(fit.kappa, abs=1e-3)
    assert load_config(path, {"method": "spacing_vector"}).constraint.spacing > 0.05


def test_at_the_told_kappa_the_constraint_comes_when_the_feet_are_closest(eight):
    made, tracks, fit = eight
    config = TrackerConfig.from_mapping({"method": "mdmd_ekf", "mdmd_ekf.kappa": fit.kappa})
    found = DualFootTracker(config).run(*align(made.left, made.right))
    left, right = truth_at(made, tracks)
    distance = np.linalg.norm(left - right, axis=1)
    stamps = [e.stamp_ns for e in found.of_kind(EventKind.CONSTRAINT)]
    at = np.searchsorted(tracks.left.stamp_ns, stamps)
    closest = [distance[max(0, k - 12) : k + 13].min() for k in at]
    assert len(at) > 50
    assert np.median(distance[at] - closest) < 0.02


def test_too_few_steps_are_refused():
    made = simulate(WalkConfig(route="standing"), seed=1)
    with pytest.raises(CalibrationError, match="0 steps were found"):
        fit_spacing(track_feet(made.left, made.right))


def test_turning_round_is_what_the_uncertainty_waits_for():
    *_, straight = fitted(route="straight")
    *_, bend = fitted(route="L")
    *_, eight = fitted(route="figure_eight")
    assert straight.feet.std_m > bend.feet.std_m > eight.feet.std_m
    assert math.degrees(eight.feet.turned_rad) > 300.0
