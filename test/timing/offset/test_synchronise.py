"""Both feet of a recording on one clock: what is reported is what was done."""

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.simulation import WalkConfig, simulate
from dualfoot_ros.timing import Offset
from dualfoot_ros.timing.offset.synchronise import synchronise

CLOCKS = {"left": (1000.0, 800.0), "right": (5000.0, -900.0)}  # s, ppm


def test_the_offset_by_arrival_is_that_at_one_moment_however_far_the_clocks_are_apart():
    walk = simulate(WalkConfig(route="L", standing=20.0), seed=1)
    rng = np.random.default_rng(0)
    series, logged = {}, {}
    for foot, (offset_s, skew_ppm) in CLOCKS.items():
        true = getattr(walk, f"{foot}_truth").stamp_ns
        elapsed = true - true[0]
        device = round(offset_s * 1e9) + np.rint(elapsed * (1.0 + 1e-6 * skew_ppm))
        series[foot] = replace(getattr(walk, foot), stamp_ns=device.astype(np.int64))
        logged[foot] = true + rng.exponential(1e6, len(true)).astype(np.int64)
    found = synchronise(series["left"], series["right"], logged, "arrival")
    middle = len(series["right"]) // 2
    host_ns = found.right.stamp_ns[middle]
    at_left = np.interp(
        host_ns, found.left.stamp_ns, found.left.stamp_ns - series["left"].stamp_ns
    )
    at_right = host_ns - series["right"].stamp_ns[middle]
    assert found.offset_s == pytest.approx(1e-9 * (at_right - at_left), abs=1e-4)
    assert found.offset_s == pytest.approx(-4000.0, abs=0.2)  # apart by 1700 ppm of half a minute


def test_the_offset_at_a_stamp_of_the_other_clock_is_that_of_the_stamp_it_came_from():
    line = Offset("arrival", 7_000_000_000, 10**18, 5000.0, True, 0.0, 1.0)
    stamp = np.array([10**18 + 3_600_000_000_000])
    moved = line.apply(stamp)
    assert line.offset_at(int(moved[0])) == pytest.approx(int(moved[0] - stamp[0]), abs=2)
