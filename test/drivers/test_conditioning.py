"""Axes, mounting and units: physics that must not change when a sensor is turned."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.drivers import Conditioner, ConditioningConfig, Sample

angles = st.floats(-6.2, 6.2)
numbers = st.floats(-100.0, 100.0)
vectors = st.tuples(numbers, numbers, numbers)
RIGHT_HANDED = ("x,y,z", "y,-x,z", "x,-y,-z", "-y,x,z", "z,x,y", "-z,-y,-x", "-x,-y,z")


def sample(force=(0.0, 0.0, 9.81), rate=(0.0, 0.0, 0.0), field=None):
    return Sample(7, force, rate, 42, magnetic_field=field, temperature=20.0, counter=3)


@given(angles, angles, angles, vectors, vectors, st.sampled_from(RIGHT_HANDED))
def test_turning_keeps_lengths_and_the_angle_between_force_and_rate(roll, pitch, yaw, f, w, axes):
    turned = Conditioner(ConditioningConfig(axes=axes, roll=roll, pitch=pitch, yaw=yaw)).apply(
        sample(f, w)
    )
    assert math.hypot(*turned.specific_force) == pytest.approx(math.hypot(*f), abs=1e-9)
    assert math.hypot(*turned.angular_rate) == pytest.approx(math.hypot(*w), abs=1e-9)
    assert np.dot(turned.specific_force, turned.angular_rate) == pytest.approx(
        np.dot(f, w), abs=1e-8
    )


def test_a_sensor_pitched_forward_reads_gravity_upwards_again_when_its_mounting_is_given():
    pitch = math.radians(28.0)  # as on the instep: the toes are lower
    reads = (-9.81 * math.sin(pitch), 0.0, 9.81 * math.cos(pitch))
    level = Conditioner(ConditioningConfig(pitch=pitch)).apply(sample(reads))
    assert level.specific_force == pytest.approx((0.0, 0.0, 9.81))


def test_axes_name_what_points_forward_left_and_up():
    turned = Conditioner(ConditioningConfig(axes="y,-x,z")).apply(sample((1.0, 2.0, 3.0)))
    assert turned.specific_force == (2.0, -1.0, 3.0)


@pytest.mark.parametrize("axes", ["y,-x,z", "+y,-x,+z", "y-xz", " y, -x, z "])
def test_axes_may_be_written_with_or_without_commas_and_plus_signs(axes):
    turned = Conditioner(ConditioningConfig(axes=axes)).apply(sample((1.0, 2.0, 3.0)))
    assert turned.specific_force == (2.0, -1.0, 3.0)


def test_g_and_degrees_become_si_and_the_field_only_turns():
    options = ConditioningConfig(axes="y,-x,z", force_unit="g", rate_unit="deg/s")
    turned = Conditioner(options).apply(sample((0, 0, 1), (0, 0, 180), (2e-5, 0, -4e-5)))
    assert turned.specific_force == pytest.approx((0, 0, 9.80665))
    assert turned.angular_rate == pytest.approx((0, 0, math.pi))
    assert turned.magnetic_field == pytest.approx((0, -2e-5, -4e-5))


def test_axes_that_cannot_be_are_refused():
    with pytest.raises(ConfigError, match="axes are 'x,-y,z': they mirror the sensor"):
        Conditioner(ConditioningConfig(axes="x,-y,z"))


def test_nothing_is_touched_when_nothing_is_asked():
    given_sample = sample((1.0, 2.0, 3.0))
    assert Conditioner().apply(given_sample) is given_sample


def test_time_counter_and_temperature_are_left_alone():
    turned = Conditioner(ConditioningConfig(yaw=1.0)).apply(sample())
    assert (turned.ticks, turned.counter, turned.temperature, turned.arrival_ns) == (
        42,
        3,
        20.0,
        7,
    )


def test_an_unknown_unit_is_refused_by_name():
    with pytest.raises(ConfigError, match="force_unit"):
        ConditioningConfig(force_unit="mg")
