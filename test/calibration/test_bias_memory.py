"""A bias memory gives the next walk what earlier stands have told, and survives bad files."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.calibration import BiasMemory, CalibrationError, RememberedStand, stands_of
from dualfoot_ros.core import DualFootTracker, TrackerConfig
from dualfoot_ros.simulation import WalkConfig, grade, simulate

biases = st.tuples(*[st.floats(-0.4, 0.4)] * 3)


def stand(*bias: float, std: float = 1e-3, second: int = 0) -> RememberedStand:
    return RememberedStand(f"2026-11-28T20:00:{second:02d}+00:00", bias, std)


@given(st.lists(biases, min_size=1, max_size=25))
def test_a_file_holds_the_newest_stands_as_they_were(tmp_path_factory, given):
    memory, path = BiasMemory(), tmp_path_factory.mktemp("memory") / "shoes.yaml"
    for second, bias in enumerate(given):
        memory.remember("left", stand(*bias, second=second))
    again = BiasMemory.load(memory.save(path))
    assert len(again.stands["left"]) == min(len(given), 20) and not again.stands["right"]
    found = [each.gyro_bias for each in again.stands["left"]]
    assert np.allclose(found, given[-20:], rtol=0.0, atol=1e-9)
    assert set(again.priors()) == {"left"}


def test_a_walk_told_again_counts_once_and_tells_itself_nothing():
    memory = BiasMemory()
    for second, bias in ((10, 0.01), (30, 0.02), (30, 0.02 + 1e-7)):
        memory.remember("left", stand(bias, 0.0, 0.0, second=second))
    assert [each.gyro_bias[0] for each in memory.stands["left"]] == [0.01, 0.02 + 1e-7]
    at_30 = int(datetime(2026, 11, 28, 20, 0, 30, tzinfo=UTC).timestamp() * 1e9) + 700_000_000
    others = memory.without(at_30 - 500_000_000, at_30 + 60_000_000_000)
    assert [each.gyro_bias[0] for each in others.stands["left"]] == [0.01]
    assert memory.without(0, 60_000_000_000) is memory  # seconds of a device are no date


def test_a_memory_that_does_not_exist_yet_is_empty(tmp_path):
    assert BiasMemory.load(tmp_path / "none.yaml").priors() == {}


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("[1, 2", "cannot be used"),
        ("format: other\n", "format is not 'dualfoot_bias_memory'"),
        ("format: dualfoot_bias_memory\nversion: 9\n", "version is 9; allowed is 1"),
        ("format: dualfoot_bias_memory\nversion: 1\nstands: {both: []}\n", "allowed are left"),
        (
            "format: dualfoot_bias_memory\nversion: 1\n"
            "stands: {left: [{gyro_bias: [1, 0, 0], std: 0.1}]}\n",
            "above 0.5 rad/s",
        ),
        (
            "format: dualfoot_bias_memory\nversion: 1\n"
            "stands: {left: [{gyro_bias: [0, 0, .nan], std: 0.1}]}\n",
            "above 0.5 rad/s",
        ),
        (
            "format: dualfoot_bias_memory\nversion: 1\n"
            "stands: {left: [{gyro_bias: [0, 0, 0], std: 0}]}\n",
            "more than 0",
        ),
    ],
)
def test_a_bad_file_is_refused_with_what_is_allowed(tmp_path, content, said):
    path = tmp_path / "bad.yaml"
    path.write_text(content)
    with pytest.raises(CalibrationError, match=said):
        BiasMemory.load(path)


def test_the_deviation_of_a_prior_is_that_of_the_next_walk():
    """Drawn from a scatter of 2 mrad/s, nine in ten of the next biases lie within two of them."""
    rng, inside = np.random.default_rng(1), []
    for _ in range(300):
        memory = BiasMemory()
        centre = rng.normal(size=3) * 0.01
        for _ in range(5):
            memory.remember("right", stand(*(centre + 2e-3 * rng.normal(size=3)), std=1e-4))
        prior = memory.priors()["right"]
        following = centre + 2e-3 * rng.normal(size=3)
        inside.append(np.abs(following - prior.mean) < 2.0 * prior.std)
    assert 0.9 < np.mean(inside) < 1.0


def test_a_walk_without_a_stand_starts_with_the_bias_of_the_memory():
    """The first half of the stand is remembered; the same sensors then walk without one."""
    made = simulate(WalkConfig(route="L", standing=6.0), grade("consumer"), seed=4)
    tracker = DualFootTracker(TrackerConfig(method="zupt"))
    memory = BiasMemory()
    known = stands_of(tracker.run(made.left, made.right))
    assert set(known) == {"left", "right"}
    for foot, each in known.items():
        memory.remember(foot, each)
    walking = slice(round(7.0 * 100), None)
    start = {}
    for name, priors in (("without", {}), ("with", memory.priors())):
        tracker = DualFootTracker(TrackerConfig(method="zupt"))
        for foot, prior in priors.items():
            tracker.declare_bias(foot, prior)
        run = tracker.run(made.left[walking], made.right[walking])
        (event,) = [e for e in run.events if e.kind == "aligned"]
        assert event.detail["start"] == "first_stance"
        start[name] = np.array(event.detail["left_gyro_bias"])
    truth = np.array(known["left"].gyro_bias)
    assert np.abs(start["with"] - truth).max() < 1e-4
    assert np.abs(start["without"] - truth).max() > 1e-3
