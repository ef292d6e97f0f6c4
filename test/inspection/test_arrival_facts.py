"""The first seconds in figures: rate, unit, gravity, axes, and what to change."""

import itertools

import numpy as np
import pytest

from dualfoot_ros.core import IDENTITY, axes_matrix
from dualfoot_ros.inspection import advice_on, arrival_facts, describe_arrival
from dualfoot_ros.inspection.arrival_facts import AXES_FOR_UP

GRAVITY = 9.80665


def facts_of(
    force=(0.0, 0.0, GRAVITY), rate=(0.01, 0.0, 0.0), *, hz=100.0, jitter_s=0.0, moving=0.0
):
    """Return the facts of 400 samples with a little noise."""
    rng = np.random.default_rng(0)
    stamps = (
        np.arange(400) / hz + rng.exponential(jitter_s, 400) if jitter_s else np.arange(400) / hz
    )
    noise = 0.002 * np.linalg.norm(force) + moving
    forces = force + rng.normal(0.0, noise, (400, 3))
    rates = rate + rng.normal(0.0, 0.002 + moving, (400, 3))
    return arrival_facts(np.rint(stamps * 1e9).astype(np.int64), forces, rates, device_time=True)


def test_a_sensor_that_is_right_needs_nothing_to_change():
    facts = facts_of()
    assert (facts.still, facts.up, facts.force_unit) == (True, "+z", "m/s^2")
    assert facts.rate_hz == pytest.approx(100.0)
    assert advice_on(facts) == {}
    assert "100.0 Hz" in describe_arrival(facts)
    assert "+z up" in describe_arrival(facts)


@pytest.mark.parametrize(
    ("scale", "unit"), [(1.0, "m/s^2"), (1 / GRAVITY, "g"), (1e3 / GRAVITY, "mg")]
)
def test_the_unit_of_the_specific_force_is_known_by_gravity(scale, unit):
    facts = facts_of((0.0, 0.0, GRAVITY * scale))
    assert facts.force_unit == unit
    assert ("units.specific_force" in advice_on(facts)) is (unit != "m/s^2")


def test_a_rate_that_no_sensor_has_tells_of_longer_ticks():
    assert "6000 samples a second cannot be" in advice_on(facts_of(hz=6000.0))["source"]
    assert advice_on(facts_of(hz=1000.0)) == {}


def test_acceleration_without_gravity_is_told():
    rng = np.random.default_rng(1)
    noise = rng.normal(0.0, 0.05, (400, 3))
    stamps = np.arange(400) * 10_000_000
    advice = advice_on(arrival_facts(stamps, noise, 0.1 * noise, device_time=False))
    assert "gravity is taken out" in advice["units.specific_force"]


@pytest.mark.parametrize("rate", [(1.5, -0.8, 0.4), (60.0, 0.0, 0.0)])
def test_an_angular_rate_in_degrees_is_told_unless_the_format_fixes_the_unit(rate):
    facts = facts_of(rate=rate)
    assert "set it to deg/s" in advice_on(facts)["units.angular_rate"]
    assert advice_on(facts, units_known=True) == {}


def test_the_upward_axis_is_named_and_the_axes_advised_are_a_rotation_that_puts_it_up():
    for sign, axis in itertools.product((1, -1), range(3)):
        force = np.zeros(3)
        force[axis] = sign * GRAVITY
        facts = facts_of(tuple(force))
        assert facts.up == f"{'+' if sign > 0 else '-'}{'xyz'[axis]}"
        rotation = IDENTITY if facts.axes is None else axes_matrix(facts.axes)
        assert np.allclose(np.array(rotation) @ force, [0.0, 0.0, GRAVITY])
        assert (facts.axes is None) is (facts.up == "+z")
    assert set(AXES_FOR_UP) == {"+x", "-x", "+y", "-y", "-z"}


def test_a_sensor_in_motion_or_at_a_slant_has_no_upward_axis():
    assert facts_of(moving=3.0).up is None
    assert facts_of((6.0, 0.0, 7.7)).up is None


def test_slow_devices_and_stamps_of_arrival_are_told():
    assert "set it to 100 or more" in advice_on(facts_of(hz=10.0))["checks.rate"]
    assert "times of arrival" in advice_on(facts_of(jitter_s=0.01))["stamp"]
