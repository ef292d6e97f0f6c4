"""Transforms from /tf: chains of them, both ways."""

import math

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped

from dualfoot_ros.core import yaw_quaternion
from dualfoot_ros.nodes.inputs.frame_transforms import FrameTransforms


def transform(parent, child, x, y, yaw):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.transform.translation.x, message.transform.translation.y = x, y
    q, turn = message.transform.rotation, yaw_quaternion(yaw)
    q.x, q.y, q.z, q.w = turn.tolist()
    return message


@pytest.fixture
def transforms(bench):
    found = FrameTransforms(bench.plain())
    found.take(
        [
            transform("earth", "map", 100.0, 0.0, 0.0),
            transform("map", "odom", 1.0, 2.0, math.pi / 2),
            transform("odom", "base", 5.0, 0.0, 0.0),
        ]
    )
    return found


def test_a_point_of_the_map_is_found_in_odom_and_back(transforms):
    there, back = transforms.find("odom", "map"), transforms.find("map", "odom")
    np.testing.assert_allclose(
        there.position(np.array([1.0, 3.0, 0.0])), [1.0, 0.0, 0.0], atol=1e-9
    )
    np.testing.assert_allclose(
        back.position(np.array([1.0, 0.0, 0.0])), [1.0, 3.0, 0.0], atol=1e-9
    )
    assert there.yaw == pytest.approx(-math.pi / 2) == -back.yaw


def test_chains_and_siblings_are_followed(transforms):
    moved = transforms.find("base", "earth").position(np.array([101.0, 7.0, 0.0]))
    np.testing.assert_allclose(moved, [0.0, 0.0, 0.0], atol=1e-9)
    same = transforms.find("odom", "odom")
    np.testing.assert_allclose(same.rotation, np.eye(3))


def test_what_is_not_connected_or_a_circle_is_not_found(transforms):
    assert transforms.find("odom", "moon") is None
    transforms.take([transform("b", "a", 0.0, 0.0, 0.0), transform("a", "b", 0.0, 0.0, 0.0)])
    assert transforms.find("odom", "a") is None


def test_a_transform_that_is_not_finite_is_passed_over(transforms):
    transforms.take([transform("map", "odom", math.nan, 0.0, 0.0)])
    assert np.isfinite(transforms.find("odom", "map").shift).all()
