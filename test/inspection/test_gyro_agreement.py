"""The gyro against the accelerometer: whatever is wrong between them is told, and by how much."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import DEGREE
from dualfoot_ros.inspection import RateError, gyro_agreement
from dualfoot_ros.inspection.gyro_agreement import LEAST_SPANS
from dualfoot_ros.inspection.quiet_spans import quiet_spans
from dualfoot_ros.simulation import WalkConfig, grade, simulate


@pytest.fixture(scope="module")
def foot():
    return simulate(WalkConfig(route="rectangle", rate=60.0, standing=4.0), seed=7).right


def turned(series, matrix):
    return replace(series, angular_rate=series.angular_rate @ np.asarray(matrix).T)


def test_parts_of_one_sensor_agree(foot):
    found = gyro_agreement(foot)
    assert found.error is RateError.NONE
    assert found.axes == "+x, +y, +z"
    assert found.residual < 0.05
    assert found.scale == pytest.approx(1.0, abs=0.04)


def signed_permutations():
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            yield matrix


WRONG = [m for m in signed_permutations() if not np.array_equal(m, np.eye(3))]


@pytest.mark.parametrize("matrix", WRONG[::5], ids=lambda m: str(m.astype(int).tolist()))
def test_other_axes_of_the_rate_are_named_with_their_handedness(foot, matrix):
    found = gyro_agreement(turned(foot, matrix))
    if np.array_equal(matrix, -np.eye(3)):
        expected = RateError.NEGATED
    else:
        expected = RateError.MIRRORED if np.linalg.det(matrix) < 0.0 else RateError.TURNED
    assert found.error is expected
    assert found.explained < 0.6 * found.residual


@pytest.mark.parametrize(
    ("factor", "error"), [(DEGREE, RateError.TOO_SMALL), (1.0 / DEGREE, RateError.TOO_LARGE)]
)
def test_degrees_taken_for_radians_are_named(foot, factor, error):
    found = gyro_agreement(turned(foot, factor * np.eye(3)))
    assert found.error is error
    assert found.scale == pytest.approx(1.0, abs=0.04)


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_the_scale_comes_out_within_its_uncertainty(factor):
    ideal = grade("ideal")
    series = simulate(WalkConfig(route="rectangle", standing=4.0), ideal, seed=7).left
    found = gyro_agreement(turned(series, factor * np.eye(3)))
    assert found.error is RateError.NONE
    assert found.scale == pytest.approx(1.0 / factor, abs=3.0 * found.scale_std)


def test_axes_of_both_may_be_turned_together(foot):
    turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    both = replace(turned(foot, turn), specific_force=foot.specific_force @ turn.T)
    here, there = gyro_agreement(foot), gyro_agreement(both)
    assert there.error is RateError.NONE
    assert there.residual == pytest.approx(here.residual, rel=1e-6)


def test_a_foot_that_only_stands_tells_nothing(foot):
    assert gyro_agreement(foot[:200]) is None
    assert gyro_agreement(foot[:1]) is None
    assert gyro_agreement(foot[:0]) is None


def test_a_span_lasts_from_quiet_to_quiet_and_holds_a_swing(foot):
    spans = quiet_spans(foot)
    assert len(spans) >= LEAST_SPANS
    assert np.linalg.norm(spans.first, axis=1) == pytest.approx(9.8, abs=1.0)
    assert np.linalg.norm(spans.force, axis=2).max(axis=0).min() > 12.0
    assert (spans.within.sum(axis=0)[:, 0] * spans.step_s == spans.duration_s).all()
