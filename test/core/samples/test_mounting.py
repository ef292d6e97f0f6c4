"""The rotation of a mounting: what is forward, left and up."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.core.samples.mounting import MountingConfig, axes_matrix

angles = st.floats(-6.2, 6.2)
RIGHT_HANDED = ("x,y,z", "y,-x,z", "x,-y,-z", "-y,x,z", "z,x,y", "-z,-y,-x", "-x,-y,z")


@given(angles, angles, angles)
def test_the_angles_are_about_fixed_axes_x_then_y_then_z(roll, pitch, yaw):
    expected = Rotation.from_euler("xyz", [roll, pitch, yaw]).as_matrix()
    found = MountingConfig(roll=roll, pitch=pitch, yaw=yaw).rotation()
    np.testing.assert_allclose(found, expected, atol=1e-14)


@pytest.mark.parametrize("axes", RIGHT_HANDED)
def test_axes_are_a_rotation_of_zeros_and_ones(axes):
    rotation = np.array(axes_matrix(axes))
    np.testing.assert_array_equal(rotation @ rotation.T, np.eye(3))
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert not np.signbit(rotation[rotation == 0.0]).any(), "a minus zero would spread"


@pytest.mark.parametrize("axes", ["y,-x,z", "+y,-x,+z", "+y-x+z", "y-xz", " y, -x, z "])
def test_one_rotation_may_be_written_in_several_ways(axes):
    assert axes_matrix(axes) == ((0, 1, 0), (-1, 0, 0), (0, 0, 1))


@given(st.sampled_from(RIGHT_HANDED), angles)
def test_axes_are_named_anew_before_they_are_turned(axes, yaw):
    found = np.array(MountingConfig(axes=axes, yaw=yaw).rotation())
    expected = Rotation.from_euler("z", yaw).as_matrix() @ np.array(axes_matrix(axes))
    np.testing.assert_allclose(found, expected, atol=1e-14)


@pytest.mark.parametrize(
    ("axes", "why"),
    [
        ("x,-y,z", "mirror"),
        ("x,x,z", "twice"),
        ("x,y", "not three"),
        ("", "not three"),
        ("a,b,c", "not three"),
        ("x,y,z,x", "not three"),
    ],
)
def test_axes_that_cannot_be_are_refused_with_a_reason(axes, why):
    with pytest.raises(ConfigError, match=why) as refusal:
        MountingConfig(axes=axes).rotation()
    assert f"'{axes}'" in str(refusal.value)
