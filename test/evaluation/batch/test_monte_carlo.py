"""The consistency of the filter: the statistics themselves, and the default configuration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.results.events import Event, EventKind
from dualfoot_ros.evaluation.batch.monte_carlo import (
    CONFIDENCE,
    POINTS,
    WalkJob,
    WalkScores,
    band,
    constraint_dimensions,
    in_gauge,
    points,
    score_walk,
    summarise,
)
from dualfoot_ros.simulation import SensorConfig, WalkConfig

from ..walks import perfect

WALKS = 12
LEAST = 0.3  # NEES on short walks: a zero-velocity update promises little of a single stride


def test_the_band_holds_the_mean_of_chi_squares_in_95_of_100_cases():
    rng = np.random.default_rng(1)
    low, high = band(20, 3)
    means = rng.chisquare(3, size=(20_000, 20)).mean(axis=1) / 3.0
    assert np.mean((means >= low) & (means <= high)) == pytest.approx(0.95, abs=0.01)


@pytest.mark.parametrize("dimensions", [1, 3])
@pytest.mark.parametrize("count", [1, 50, 100_000])
def test_the_band_is_that_of_the_chi_square_distribution(count, dimensions):
    freedom = count * dimensions
    shares = [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2]
    assert band(count, dimensions) == tuple(chi2.ppf(shares, freedom) / freedom)


def test_more_walks_have_a_narrower_band_about_one():
    few, many = band(10, 3), band(1000, 3)
    assert few[0] < many[0] < 1.0 < many[1] < few[1]
    assert many[1] - many[0] < 0.11


def drawn(true_std: float, walks: int = 200) -> list[WalkScores]:
    """Return scores of walks whose filter claims 1 and errs by ``true_std``."""
    rng = np.random.default_rng(3)
    found = []
    for _ in range(walks):
        error = rng.normal(size=(POINTS, 3)) * true_std
        nis = rng.chisquare(3, size=50) / 3.0 * true_std**2
        scores = {"left position": (error**2).mean(axis=1)}
        squares = {"left position": (float((error**2).mean()), 1.0)}
        found.append(WalkScores(scores, squares, {"zero velocity": nis}))
    return found


def test_an_honest_filter_is_within_its_bands():
    nees, nis = summarise(drawn(1.0), TrackerConfig())
    assert nees.band[0] < nees.mean < nees.band[1] and nees.inside > 0.85
    assert nis.band[0] < nis.mean < nis.band[1]
    assert (nees.kind, nis.kind, nees.dimensions) == ("NEES", "NIS", 3)


@pytest.mark.parametrize("true_std", (0.5, 2.0))
def test_a_dishonest_filter_is_told_by_how_much(true_std):
    nees, nis = summarise(drawn(true_std), TrackerConfig())
    assert nees.mean == pytest.approx(true_std**2, rel=0.05)
    assert nis.mean == pytest.approx(true_std**2, rel=0.05)
    assert nees.inside == 0.0
    assert nees.error / nees.std == pytest.approx(true_std, rel=0.05)


def test_points_are_stances_at_equal_steps_of_the_walk():
    middles = np.arange(100, 5000, 37)
    chosen = points(middles, 500)
    assert len(chosen) == POINTS
    assert set(chosen) <= set(middles) and chosen[0] >= 500 and chosen[-1] == middles[-1]
    assert np.diff(chosen).max() < 2 * (5000 - 500) / POINTS


def test_the_gauge_takes_start_and_first_strides_away_and_no_error():
    """The estimate errs by 3 degrees and 1 m from the start: that is an error, not a gauge."""
    run, truth = perfect()
    heading = Event(EventKind.HEADING, 0, "right", 0)
    run = replace(run, events=(heading,))
    wrong = replace(run, right=replace(run.right, position=run.right.position + 1.0))
    for estimate in (run, wrong):
        left, right = in_gauge(truth, estimate, TrackerConfig())
        middle = 0.5 * (left.position[0] + right.position[0])
        assert np.allclose(middle, 0.0, atol=1e-12)
        assert np.allclose(np.diff(right.position[:, 1])[100:200], 0.0, atol=1e-9)
    assert np.allclose(np.linalg.norm(left.velocity - truth[0].velocity, axis=1), 0.0, atol=1e-9)


def test_the_dimensions_of_a_constraint_are_those_of_its_innovation():
    for method, dimensions in (("idc", 1), ("spacing_vector", 3), ("step_length", 3)):
        assert constraint_dimensions(TrackerConfig(method=method)) == dimensions
    lateral = {"method": "spacing_vector", "spacing_vector.variant": "lateral"}
    assert constraint_dimensions(TrackerConfig.from_mapping(lateral)) == 2


@pytest.fixture(scope="module")
def default_scores():
    """Return the scores of the default configuration over seeded walks, by name."""
    walk = WalkConfig(route="rectangle", rate=60.0, standing=6.0, final_standing=1.0)
    jobs = [WalkJob(seed, walk, SensorConfig(), TrackerConfig()) for seed in range(WALKS)]
    scores = summarise([score_walk(job) for job in jobs], TrackerConfig())
    return {score.name: score for score in scores}


@pytest.mark.parametrize("part", ["position", "horizontal", "height", "attitude", "heading"])
@pytest.mark.parametrize("foot", ["left", "right"])
def test_the_default_keeps_what_it_promises_on_simulated_walks(default_scores, foot, part):
    score = default_scores[f"{foot} {part}"]
    assert LEAST <= score.mean <= score.band[1], f"{score.name}: NEES {score.mean:.2f}"


@pytest.mark.parametrize("part", ["position", "horizontal", "height"])
def test_the_feet_are_closer_together_than_is_promised(default_scores, part):
    """On a floor without steps: what the constraint allows is for people who climb stairs."""
    score = default_scores[f"relative {part}"]
    assert 0.05 < score.mean < 1.0, f"{score.name}: NEES {score.mean:.2f}"


@pytest.mark.parametrize("foot", ["left", "right"])
def test_the_velocity_in_stance_is_better_than_is_promised(default_scores, foot):
    """A zero-velocity update has a noise that is right for a whole stance.

    Its errors are alike, and so the noise is too large for a single sample.
    """
    assert 0.05 < default_scores[f"{foot} velocity"].mean < 1.0


def test_the_noise_of_constraint_and_zero_velocity_is_not_below_their_innovations(default_scores):
    """Innovations of a stance are alike, so their noise must be larger than each of them is."""
    for name in ("constraint", "zero velocity"):
        assert 0.005 < default_scores[name].mean < 1.0


@pytest.mark.parametrize(
    ("aid", "name"), [("magnetic_heading", "left heading"), ("barometer", "left height")]
)
def test_an_aid_is_scored_with_the_sensor_that_it_needs(aid, name):
    walk = WalkConfig(route="rectangle", rate=60.0, standing=4.0, final_standing=1.0)
    on = TrackerConfig.from_mapping({f"aids.{aid}": True, "aids.magnetic_std": 0.1})
    plain, aided = (
        score_walk(WalkJob(3, walk, SensorConfig(), config)) for config in (TrackerConfig(), on)
    )
    variances = [scores.squares[name][1] for scores in (plain, aided)]
    assert variances[1] < 0.8 * variances[0]
