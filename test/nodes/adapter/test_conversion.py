import numpy as np
import pytest

from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.core.samples.mounting import MountingConfig
from dualfoot_ros.nodes.adapter.conversion import Conversion
from dualfoot_ros.nodes.ros.messages import new_imu
from dualfoot_ros.settings.nodes import CovarianceConfig, UnitConfig

VALUES = np.array([1.0, -2.0, 9.0, 0.3, 0.1, -0.5])


def test_without_mounting_and_units_a_sample_keeps_its_bits():
    values = Conversion(MountingConfig(), UnitConfig(), CovarianceConfig()).values(VALUES)
    np.testing.assert_array_equal(values, VALUES)


def test_a_sensor_worn_backwards_is_turned_forward():
    turned = Conversion(MountingConfig(yaw=np.pi), UnitConfig(), CovarianceConfig()).values(VALUES)
    np.testing.assert_allclose(turned, [-1.0, 2.0, 9.0, -0.3, -0.1, -0.5], atol=1e-12)


def test_axes_are_named_anew_before_they_are_turned():
    turned = Conversion(
        MountingConfig(axes="y,-x,z", yaw=np.pi / 2), UnitConfig(), CovarianceConfig()
    )
    np.testing.assert_allclose(turned.values(VALUES), VALUES, atol=1e-12)
    plain = Conversion(MountingConfig(axes="y,-x,z"), UnitConfig(), CovarianceConfig())
    np.testing.assert_allclose(plain.values(VALUES), [-2.0, -1.0, 9.0, 0.1, -0.3, -0.5])


def test_axes_that_mirror_the_sensor_are_refused():
    with pytest.raises(ConfigError, match="they mirror the sensor"):
        Conversion(MountingConfig(axes="x,-y,z"), UnitConfig(), CovarianceConfig())


def test_g_and_degrees_become_si():
    units = UnitConfig(specific_force="g", angular_rate="deg/s")
    values = Conversion(MountingConfig(), units, CovarianceConfig()).values(
        np.array([0, 0, 1.0, 0, 0, 180.0])
    )
    np.testing.assert_allclose(values, [0, 0, 9.80665, 0, 0, np.pi])


def test_covariances_turn_and_scale_with_the_values():
    message = new_imu("sensor")
    message.linear_acceleration_covariance = np.diag([1.0, 4.0, 9.0]).ravel()
    units = UnitConfig(specific_force="g")
    Conversion(MountingConfig(yaw=np.pi / 2), units, CovarianceConfig()).convert_covariances(
        message
    )
    expected = 9.80665**2 * np.diag([4.0, 1.0, 9.0])
    found = np.asarray(message.linear_acceleration_covariance).reshape(3, 3)
    np.testing.assert_allclose(found, expected, atol=1e-10)


def test_a_given_noise_takes_the_place_of_what_was_received():
    message = new_imu("sensor")
    Conversion(
        MountingConfig(), UnitConfig(), CovarianceConfig(angular_rate_std=0.1)
    ).convert_covariances(message)
    assert message.angular_velocity_covariance[[0, 4, 8]] == pytest.approx(0.01)


def test_the_orientation_of_a_turned_sensor_is_not_passed_on():
    message = new_imu("sensor")
    message.orientation_covariance[0] = 0.5
    Conversion(MountingConfig(yaw=1.0), UnitConfig(), CovarianceConfig()).convert_covariances(
        message
    )
    assert message.orientation_covariance[0] == -1.0
