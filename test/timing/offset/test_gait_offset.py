"""The gait tells the right cycle of long even walks, a skew, and when it cannot tell."""

import re
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import ClockConfig, WalkConfig, simulate, walk
from dualfoot_ros.timing import TimingError, offset_by_motion

OFFSET_S = 12.5


@cache
def way(seed, route):
    return walk(WalkConfig(route=route, rate=60.0), seed)


def walked(seed, drift=0.0, route="L"):
    clocks = ClockConfig(), ClockConfig(offset=OFFSET_S, drift=drift)
    return simulate(way(seed, route), clock=clocks, seed=seed)


@pytest.mark.parametrize("seed", [0, 6])
def test_a_lap_without_a_stop_is_found_at_the_right_cycle(seed):
    made = walked(seed, route="track")
    found = offset_by_motion(made.left, made.right, "motion")
    assert found.offset_ns * 1e-9 == pytest.approx(-OFFSET_S, abs=0.01)
    assert found.confidence > 0.9
    assert found.notes == ()


@pytest.mark.parametrize("drift", [-900.0])
def test_a_skew_of_900_ppm_on_a_lap_is_found(drift):
    made = walked(0, drift=drift, route="track")
    found = offset_by_motion(made.left, made.right, "motion")
    assert found.skew_known
    assert found.skew_ppm == pytest.approx(drift, abs=15.0)
    moved = found.apply(made.right.stamp_ns)
    assert np.abs(moved - made.right_truth.stamp_ns).max() < 10_000_000


def test_a_skew_beyond_what_the_gait_tells_is_doubtful():
    made = walked(1, drift=2000.0, route="track")
    found = offset_by_motion(made.left, made.right, "motion")
    assert found.confidence < 0.5
    assert "doubtful" in found.notes[0]


@pytest.mark.parametrize("drift", [-5000.0, 20_000.0])
def test_a_skew_far_beyond_is_named_as_a_cause(drift):
    made = walked(1, drift=drift, route="track")
    try:
        found = offset_by_motion(made.left, made.right, "motion")
        said = found.notes[0]
        assert found.confidence < 0.5
    except TimingError as refused:
        said = str(refused)
    named = re.search(r"skew is near ([+-]\d+) ppm", said)
    assert named is not None, said
    assert float(named[1]) == pytest.approx(drift, abs=4000.0)  # a step in a lap


@pytest.mark.parametrize(("one", "two"), [(1, 2), (2, 1), (3, 4)])
def test_the_feet_of_two_walks_are_doubtful_or_refused(one, two):
    left, right = walked(one, route="L").left, walked(two, route="L").right
    try:
        found = offset_by_motion(left, right, "motion")
    except TimingError:
        return
    assert found.confidence < 0.5
    assert "doubtful" in found.notes[0]
    assert "shake" in found.notes[0]


def test_feet_of_two_real_walks_are_doubtful_or_refused_and_those_of_one_are_sure(dual_feet):
    paths = [dual_feet / "unsynchronised" / f"HR_2Laces_ccw_{n}.mat" for n in range(1, 6)]
    walks = [import_recording(ImportOptions(sources=(path,))) for path in paths]
    sure = set()
    for i, one in enumerate(walks):
        for j, two in enumerate(walks):
            try:
                found = offset_by_motion(one.left, two.right, "motion")
            except TimingError:
                continue
            if found.confidence >= 0.5:
                sure.add((i, j))
            else:
                assert "doubtful" in found.notes[0]
    assert sure == {(k, k) for k in range(len(walks))}
