"""Calibration files in the live nodes: the same correction as offline."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.calibration import Calibration, CalibrationError, SensorCalibration, Triad
from dualfoot_ros.core import MountingConfig
from dualfoot_ros.core.errors import DualFootError
from dualfoot_ros.nodes.adapter.conversion import Conversion
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.ros.messages import imu_values
from dualfoot_ros.settings.nodes import CovarianceConfig, UnitConfig

from ..samples import STANDING, imu, imu_bytes
from ..test_imu_adapter import relayed

BIAS = np.array([0.1, -0.2, 0.3])
MATRIX = np.array([[1.01, 0.0, 0.0], [0.02, 0.99, 0.0], [0.0, 0.01, 1.02]])


@pytest.fixture
def both(tmp_path):
    """Return a file with another bias for each foot."""
    found = Calibration().with_triad("left", "accelerometer", Triad(BIAS, MATRIX))
    found = found.with_triad("right", "gyro", Triad(0.1 * BIAS, np.eye(3)))
    found.save(tmp_path / "both.yaml")
    return str(tmp_path / "both.yaml")


def test_the_adapter_corrects_with_the_calibration_of_its_foot(bench, both):
    got, _ = relayed(bench, {"calibration": both}, [imu(1)])
    expected = np.concatenate([MATRIX @ (STANDING[:3] - BIAS), STANDING[3:]])
    np.testing.assert_allclose(imu_values(got[0]), expected, atol=1e-9)


@given(st.floats(-3.0, 3.0), st.sampled_from(["m/s^2", "g"]))
def test_samples_are_corrected_in_si_and_in_the_axes_of_the_sensor_then_turned(yaw, unit):
    scale = 9.80665 if unit == "g" else 1.0
    triad = SensorCalibration(Triad(BIAS, MATRIX))
    plain = Conversion(MountingConfig(yaw=yaw), UnitConfig(), CovarianceConfig())
    whole = Conversion(
        MountingConfig(yaw=yaw), UnitConfig(specific_force=unit), CovarianceConfig(), triad
    )
    corrected = triad.values(STANDING)
    sent = np.concatenate([STANDING[:3] / scale, STANDING[3:]])
    np.testing.assert_allclose(whole.values(sent), plain.values(corrected), atol=1e-9)


def test_a_calibration_that_cannot_be_used_stops_the_node_with_its_sentence(bench, both, tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("format: something\n")
    with pytest.raises(CalibrationError, match="format is 'something'"):
        bench.add(FusionNode, {"calibration": str(bad)})
    with pytest.raises(DualFootError, match=r"parameter 'calibration' is '.*no\.yaml': No such"):
        bench.add(FusionNode, {"calibration": str(tmp_path / "no.yaml")})


@pytest.mark.parametrize("path", ["both", "one foot", "no.yaml"])
def test_an_adapter_that_is_on_no_known_foot_does_not_take_the_calibration_of_one(
    bench, both, tmp_path, path
):
    only = Calibration().with_triad("left", "accelerometer", Triad(BIAS, MATRIX))
    only.save(tmp_path / "left.yaml")
    given = {"both": both, "one foot": str(tmp_path / "left.yaml"), "no.yaml": path}[path]
    said = "is 'no.yaml': No such file" if path == "no.yaml" else "set foot to left or right"
    with pytest.raises(CalibrationError, match=f"parameter 'calibration'.*{said}"):
        bench.add(ImuAdapterNode, {"calibration": given})


def test_an_adapter_on_no_known_foot_takes_a_calibration_without_one_and_says_so(
    bench, tmp_path, capfd
):
    found = Calibration().with_triad("sensor", "accelerometer", Triad(BIAS, MATRIX))
    found.save(tmp_path / "sensor.yaml")
    node = bench.add(ImuAdapterNode, {"calibration": str(tmp_path / "sensor.yaml")})
    expected = np.concatenate([MATRIX @ (STANDING[:3] - BIAS), STANDING[3:]])
    np.testing.assert_allclose(node._conversion.values(STANDING), expected)
    assert "taken for the left foot" in capfd.readouterr().err


def test_an_adapter_takes_the_foot_of_its_parameter(bench, both, capfd):
    node = bench.add(ImuAdapterNode, {"calibration": both, "foot": "right"})
    expected = np.concatenate([STANDING[:3], STANDING[3:] - 0.1 * BIAS])
    np.testing.assert_allclose(node._conversion.values(STANDING), expected, atol=1e-9)
    assert "taken for" not in capfd.readouterr().err


def test_fusion_corrects_each_foot_before_anything_else(bench, both, monkeypatch):
    node = bench.add(FusionNode, {"calibration": both})
    seen = {}
    monkeypatch.setattr(
        node.streams.aligner, "push", lambda foot, _, v, *__: seen.update({foot: v}) or []
    )
    for foot in ("left", "right"):
        node.streams.receive(foot, imu_bytes(1))
    expected = np.concatenate([MATRIX @ (STANDING[:3] - BIAS), STANDING[3:]])
    np.testing.assert_allclose(seen["left"], expected, atol=1e-9)
    expected = np.concatenate([STANDING[:3], STANDING[3:] - 0.1 * BIAS])
    np.testing.assert_allclose(seen["right"], expected, atol=1e-9)
