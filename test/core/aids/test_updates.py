"""What the aids ask for, and that it is the Kalman update of the measurement they claim."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from dualfoot_ros.core.aids import WORN, Barometer, FlatFloor, PressureLog, height_pressure
from dualfoot_ros.core.groups import AidsConfig

from ..constraints.joint import MadeUpGait, apart, assert_dense_update, stance, states

CONFIG = AidsConfig(
    barometer=True, flat_floor=True, barometer_std=0.2, floor_std=0.03, static_std=0.05
)


def gait_until(now: int) -> MadeUpGait:
    """Return a gait that remembers everything up to epoch ``now``."""
    return MadeUpGait(np.ones((2, now + 1), dtype=bool))


def rows(*which: int) -> np.ndarray:
    """Return the measurement rows (m, 30) of single error states."""
    return np.eye(30)[list(which)]


@pytest.mark.parametrize("foot", [0, 1])
@pytest.mark.parametrize("seed", range(3))
def test_the_floor_is_an_update_of_the_height_now(foot, seed):
    space, estimate = apart(seed, 0.2)
    aid = FlatFloor(CONFIG)
    aid.moved(1.5, 0.0)
    (request,) = aid.on_stance_start(stance(foot, 10, 20), gait_until(20))
    assert (request.epoch, request.roll_back) == (20, False)
    before, P = states(space), space.covariance()
    z = estimate.position(foot)[2]
    outcome = request.apply(estimate)
    assert outcome.innovation == pytest.approx(z - 1.5)
    assert_dense_update(before, P, space, rows(15 * foot + 2), 0.03**2, z - 1.5)


@pytest.mark.parametrize("foot", [0, 1])
@pytest.mark.parametrize("seed", range(3))
def test_the_place_is_an_update_of_both_coordinates_at_the_end_of_the_stance(foot, seed):
    space, estimate = apart(seed, 0.2)
    aid = FlatFloor(CONFIG)
    aid.on_stance_start(stance(foot, 10, 20), gait_until(20))[0].apply(estimate)
    stood = estimate.position(foot)
    slid = np.array([0.04, -0.03, 0.02])
    estimate.place(foot, stood + slid)
    (request,) = aid.on_stance_end(stance(foot, 10, 40), gait_until(48))
    assert (request.epoch, request.roll_back) == (40, True)
    before, P = states(space), space.covariance()
    outcome = request.apply(estimate)
    assert outcome.innovation == pytest.approx(slid[:2])
    H = rows(15 * foot, 15 * foot + 1)
    assert_dense_update(before, P, space, H, 0.05**2 * np.eye(2), slid[:2])
    assert aid.on_stance_end(stance(foot, 10, 40), gait_until(48)) == ()


@pytest.mark.parametrize("foot", [0, 1])
@pytest.mark.parametrize("seed", range(3))
def test_the_barometer_is_an_update_of_the_height_at_the_end_of_the_stance(foot, seed):
    space, estimate = apart(seed, 0.2)
    logs = {worn: PressureLog() for worn in WORN}
    aid, gait = Barometer(CONFIG, logs, Counter()), gait_until(200)
    heights = {(10, 40): [120.0] * 31, (100, 140): np.linspace(122.0, 124.0, 41).tolist()}
    for (first, last), measured in heights.items():
        for epoch, height in zip(range(first, last + 1), measured, strict=True):
            logs["both"].add(gait.stamp(epoch), height_pressure(height))
        logs["both"].add(gait.stamp(last + 1), height_pressure(500.0))  # in swing: not used
    z = []
    for first, last in heights:
        aid.on_stance_start(stance(foot, first, first + 5), gait)
        (request,) = aid.on_stance_end(stance(foot, first, last), gait)
        assert (request.epoch, request.roll_back) == (last, True)
        before, P = states(space), space.covariance()
        z.append(estimate.position(foot)[2])
        outcome = request.apply(estimate)
        assert outcome.accepted == (len(z) == 2)
    innovation = z[1] - (z[0] + 3.0)
    assert outcome.innovation == pytest.approx(innovation, abs=1e-6)
    assert_dense_update(before, P, space, rows(15 * foot + 2), 0.2**2, innovation)


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_too_few_samples_in_a_stance_are_no_height(count):
    logs, counters = {worn: PressureLog() for worn in WORN}, Counter()
    aid, gait = Barometer(CONFIG, logs, counters), gait_until(60)
    for k in range(count):
        logs["left"].add(gait.stamp(10 + k), 101325.0)
    aid.on_stance_start(stance(0, 10, 15), gait)
    found = aid.on_stance_end(stance(0, 10, 40), gait)
    assert len(found) == (count >= CONFIG.barometer_samples == 3)
    assert counters["stances_without_pressure"] == (count < 3)
