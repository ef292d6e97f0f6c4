"""Between two samples: the turn and push of the tail of one and the head of the next."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.timing import AlignerConfig, align
from dualfoot_ros.timing.pairing.interpolation import between, between_rows

numbers = st.floats(-1.0, 1.0)
vectors = st.tuples(numbers, numbers, numbers)
weights = st.floats(0.0, 1.0)
SMALL = 1e-3  # rad and m/s of an interval, so that third order does not count


def held_push(alpha, gamma):
    """Return the push, in the axes at the start, of a force held while the body turns."""
    return gamma + 0.5 * np.cross(alpha, gamma) + np.cross(alpha, np.cross(alpha, gamma)) / 6.0


@given(vectors, vectors, vectors, vectors, weights)
def test_tail_and_head_turn_and_push_as_one_sample_does(f, w, g, v, weight):
    f, w, g, v = (SMALL * np.array(vector) for vector in (f, w, g, v))
    made = np.array(between([*f, *w], [*g, *v], weight, 1.0))
    tail, head = Rotation.from_rotvec((1.0 - weight) * w), Rotation.from_rotvec(weight * v)
    expected = (tail * head).as_rotvec()
    assert np.allclose(made[3:], expected, rtol=0.0, atol=SMALL**3)
    pushed = held_push((1.0 - weight) * w, (1.0 - weight) * f)
    pushed = pushed + tail.apply(held_push(weight * v, weight * g))
    assert np.allclose(held_push(made[3:], made[:3]), pushed, rtol=0.0, atol=SMALL**3)


@given(vectors, vectors, vectors, vectors, st.sampled_from([0.0, 1.0]))
def test_at_a_sample_the_value_is_the_sample(f, w, g, v, weight):
    assert between([*f, *w], [*g, *v], weight, 0.02) == pytest.approx(
        [*g, *v] if weight else [*f, *w], abs=1e-15
    )


def test_rows_and_single_samples_have_the_same_bits():
    rng = np.random.default_rng(4)
    before, after = rng.normal(size=(2, 200, 6)) * 9.0
    weight, width_s = rng.random(200), rng.random(200) * 0.05
    rows = between_rows(before, after, weight, width_s)
    for k in range(200):
        one = between(before[k].tolist(), after[k].tolist(), float(weight[k]), float(width_s[k]))
        assert one == rows[k].tolist()


def cone(stamps_s, tilt=0.3, turn=2.0 * math.pi):
    """Return the attitude of a coning body at ``stamps_s``."""
    t = turn * stamps_s
    return Rotation.from_euler("ZYZ", np.column_stack([t, np.full(len(t), tilt), -t]))


@pytest.mark.parametrize("phase", [0.2, 0.5, 0.8])
def test_a_foot_sampled_beside_the_grid_does_not_drift_about_its_cone(phase):
    """Compensated increments at 60 Hz; the line alone turns by 6 w (1 - w) coning terms."""
    dt_ns, count = 16_666_667, 60 * 20
    grid = np.arange(count + 4) * dt_ns
    own = grid - round(phase * dt_ns)
    rates = {}
    for name, stamps in (("left", grid), ("right", own)):
        edges = cone(np.append(stamps[0] - dt_ns, stamps) * 1e-9)
        rates[name] = (edges[:-1].inv() * edges[1:]).as_rotvec() / (dt_ns * 1e-9)
    force = np.zeros((count + 4, 3))
    left, right = ImuSeries(grid, force, rates["left"]), ImuSeries(own, force, rates["right"])
    _, paired = align(left, right, AlignerConfig(tolerance=0.0))
    turned = cone(paired.stamp_ns[:1] * 1e-9)
    for rate in paired.angular_rate[1:]:
        turned = turned * Rotation.from_rotvec(rate * dt_ns * 1e-9)
    drift = (turned * cone(paired.stamp_ns[-1:] * 1e-9).inv()).magnitude()[0]
    step = 2.0 * math.pi * dt_ns * 1e-9
    lost = 0.5 * phase * (1.0 - phase) * (step * math.sin(0.3)) ** 2 * step * count
    assert lost > 0.009
    assert drift < 0.1 * lost
