"""What a turn of a whole track is to the filter: nothing, in a walk of any length."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.constraints.spacing_vector import SpacingVector, SpacingVectorConfig
from dualfoot_ros.core.joint_estimate import JointEstimate
from dualfoot_ros.core.kernel import Workspace, interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.strapdown import mechanize
from dualfoot_ros.core.kernel.turn import (
    HEADING,
    LONG_S,
    SMALL_ANGLE,
    add_heading,
    keeps_gauge,
)
from dualfoot_ros.core.kernel.zero_velocity import zupt

from ..dense import AS_THE_PAPER
from .states import SAMPLE, nominal, random_workspace, set_covariance

TURN = 1e3  # rad, standard deviation of a turn beside which all else is small
CORRECTED = {"considering": {}, "as the papers": AS_THE_PAPER}


def turned(space: Workspace, feet) -> np.ndarray:
    """Return what a turn of the whole tracks of ``feet`` is in the error states (30,)."""
    g = np.zeros(30)
    for foot in feet:
        position, velocity = nominal(space.w, foot)[:2]
        g[lay.position_row(foot, 0) : lay.position_row(foot, 2)] = -position[1], position[0]
        g[lay.velocity_row(foot, 0) : lay.velocity_row(foot, 2)] = -velocity[1], velocity[0]
        g[lay.attitude_row(foot, 2)] = -1.0
    return g


def turned_anyhow(config: TrackerConfig, feet, seconds: float = 2.0 * LONG_S) -> Workspace:
    """Return feet that move after ``seconds`` of walk, and may be turned by any angle."""
    space = random_workspace(5, config)
    for foot in range(2):
        mechanize(space.w, foot, 0.01, SAMPLE + 6 * foot)
    space.w[lay.TRACKED] = seconds
    g = turned(space, feet)
    set_covariance(space, space.covariance() + TURN**2 * np.outer(g, g))
    return space


def off(space: Workspace, feet) -> float:
    """Return by how much P, over the variance of the turn, is not that of the turn."""
    g = turned(space, feet)
    return float(np.abs(space.covariance() / TURN**2 - np.outer(g, g)).max())


@pytest.mark.parametrize("gain", CORRECTED)
@pytest.mark.parametrize("foot", (0, 1))
def test_a_zero_velocity_shows_no_turn_and_what_it_corrects_turns_with_the_track(foot, gain):
    config = TrackerConfig.from_mapping({"method": "zupt", **CORRECTED[gain]})
    space = turned_anyhow(config, [foot])
    before = nominal(space.w, foot)[1]
    zupt(space.w, foot)
    assert np.linalg.norm(nominal(space.w, foot)[1] - before) > 0.01
    assert off(space, [foot]) < 1e-4
    P = space.covariance()
    assert np.array_equal(P, P.T)
    assert np.linalg.eigvalsh(P)[0] > -1e-12 * np.trace(P)


def test_feet_that_do_not_fit_show_no_turn_of_both_and_move_with_it():
    space = turned_anyhow(TrackerConfig(), [0, 1])
    before = nominal(space.w, 0)[0]
    SpacingVector(SpacingVectorConfig()).apply(JointEstimate(space, interpreted()), 0.7)
    assert np.linalg.norm(nominal(space.w, 0)[0] - before) > 0.01
    assert off(space, [0, 1]) < 1e-4


@pytest.mark.parametrize("foot", (0, 1))
def test_adding_the_heading_to_a_state_is_a_congruence(foot):
    space = random_workspace(2)
    T = np.eye(30)
    T[15 * foot + lay.E_VEL, 15 * foot + HEADING] = 0.7
    wanted = T @ space.covariance() @ T.T
    add_heading(space.w, foot, lay.E_VEL, 0.7)
    found = space.covariance()
    assert np.allclose(found, wanted, rtol=1e-12, atol=1e-15)
    assert np.array_equal(found, found.T)


def test_a_short_walk_with_a_heading_that_is_known_is_tracked_as_in_the_papers():
    space = random_workspace(1)
    variances = space.own_block(0), space.own_block(1)
    for block in variances:
        block[HEADING, HEADING] = 0.9 * SMALL_ANGLE**2
    space.w[lay.TRACKED] = 0.9 * LONG_S
    assert not keeps_gauge(space.w, 0)
    variances[1][HEADING, HEADING] = 1.1 * SMALL_ANGLE**2
    assert [bool(keeps_gauge(space.w, foot)) for foot in range(2)] == [False, True]
    space.w[lay.TRACKED] = 1.1 * LONG_S
    assert keeps_gauge(space.w, 0)
