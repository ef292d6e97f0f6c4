"""Messages become the rows of a trajectory again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import EvaluationError
from dualfoot_ros.nodes.demo.collector import CollectorNode, foot_trajectory
from dualfoot_ros.nodes.ros.cdr_odometry import OdometryBytes, OdometryNumbers
from dualfoot_ros.nodes.ros.messages import fill_foot

numbers = st.floats(-10.0, 10.0)


class Estimate:
    """What a foot's estimate has, from plain numbers."""

    def __init__(self, position, velocity, euler, factor):
        self.position, self.velocity = position, velocity
        self.quaternion = Rotation.from_euler("xyz", euler).as_quat()
        self.angular_rate = np.zeros(3)
        self._factor = factor

    def pose_covariance(self):
        return self._factor @ self._factor.T

    def twist_covariance(self):
        return self._factor[:3] @ self._factor[:3].T


@given(
    arrays(np.float64, 3, elements=numbers),
    arrays(np.float64, 3, elements=numbers),
    arrays(np.float64, 3, elements=st.floats(-1.5, 1.5)),
    arrays(np.float64, (6, 6), elements=numbers),
)
def test_an_estimate_that_was_published_is_read_back(position, velocity, euler, factor):
    message, estimate = OdometryBytes("odom", "foot"), Estimate(position, velocity, euler, factor)
    fill_foot(message, 7, estimate, 1e-4)
    track = foot_trajectory(OdometryNumbers([message.data()]))
    assert track.stamp_ns.tolist() == [7]
    np.testing.assert_array_equal(track.position[0], position)
    np.testing.assert_array_equal(track.quaternion[0], estimate.quaternion)
    pose = estimate.pose_covariance()
    np.testing.assert_array_equal(track.position_covariance[0], pose[:3, :3])
    np.testing.assert_array_equal(track.attitude_covariance[0], pose[3:, 3:])
    np.testing.assert_allclose(track.velocity[0], velocity, atol=1e-12)
    twist = estimate.twist_covariance()
    np.testing.assert_allclose(track.velocity_covariance[0], twist, atol=1e-11)


def odometry(stamp_ns, variance):
    message = OdometryBytes("odom", "foot")
    message.stamp(stamp_ns)
    message.quaternion[3] = 1.0
    message.pose_covariance[:] = variance * np.eye(6)
    return message.data()


def test_only_what_both_feet_and_the_person_have_makes_a_row(bench):
    node = bench.add(CollectorNode)
    for name, stamps in (("left", (1, 2, 3)), ("right", (2, 3, 4)), ("person", (1, 2, 3, 4))):
        node.messages[name] += [odometry(stamp, 1.0) for stamp in stamps]
    assert node.trajectory("zupt", {}).left.stamp_ns.tolist() == [2, 3]


@pytest.mark.parametrize(("person", "relative"), [(0.5, 2.0), (1.0, 0.0)])
def test_the_covariance_between_the_feet_follows_from_that_of_the_person(bench, person, relative):
    """Independent feet: the mean has half, the difference twice the variance of one.

    The height of the person is that of the floor and says nothing of the feet.
    """
    node = bench.add(CollectorNode)
    for name, variance in (("left", 1.0), ("right", 1.0), ("person", person)):
        node.messages[name].append(odometry(1, variance))
    found = node.trajectory("zupt", {}).relative_covariance
    np.testing.assert_allclose(found, [np.diag([relative, relative, 2.0])], atol=1e-12)


def test_nothing_published_is_an_error_that_says_so(bench):
    with pytest.raises(EvaluationError, match="at least one"):
        bench.add(CollectorNode).trajectory("zupt", {})
