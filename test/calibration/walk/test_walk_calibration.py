"""The calibration of both sensors from walks: files, checks, remarks, and the pivot."""

import numpy as np
import pytest

from dualfoot_ros.calibration import CalibrationError, calibrate_walks, fit_pivot
from dualfoot_ros.calibration.sensor import SensorCalibration, Triad
from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.recording import Recording

from .simulated import accelerometer, recording, true_elements

FEET = ("left", "right")


@pytest.fixture(scope="module")
def result():
    """Return the calibration from two loops."""
    loops = [("slow", recording(5, speed=0.9)), ("usual", recording(5))]
    return calibrate_walks(loops, given={foot: accelerometer("full") for foot in FEET})


@pytest.fixture(scope="module")
def bare():
    """Return the calibration from a short walk by sensors of which nothing is known."""
    return calibrate_walks([("corner", recording(5, "L"))])


def test_both_sensors_are_calibrated_and_their_accelerometers_are_kept(result):
    given = {foot: accelerometer("full") for foot in FEET}
    sensors = result.sensors(given)
    for foot in FEET:
        assert sensors[foot].accelerometer is given[foot].accelerometer
        gyro = sensors[foot].gyro
        assert np.allclose(gyro.matrix, gyro.matrix.T)
        assert gyro.about["walks"] == 2
        elements = gyro.matrix[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] - [1, 1, 1, 0, 0, 0]
        off = (elements - true_elements(5, foot)) / result.feet[foot].elements_std
        assert np.abs(off).max() < 3.5


def test_a_gyro_bias_that_is_known_already_is_kept_and_changes_no_matrix(bare):
    bias = np.array([0.01, -0.02, 0.005])
    given = {f: SensorCalibration(gyro=Triad(bias, 1.01 * np.eye(3))) for f in FEET}
    again = calibrate_walks([("corner", recording(5, "L"))], None, given)
    for foot in FEET:
        assert np.array_equal(again.feet[foot].triad().bias, bias)
        change = again.feet[foot].fit.elements - bare.feet[foot].fit.elements
        assert np.abs(change).max() < 1e-4


def test_loops_are_checked_with_the_matrix_of_the_other_walks(result):
    assert list(result.checks) == ["slow", "usual"]
    for check in result.checks.values():
        assert check.before.closure_percent is not None
        assert check.after.closure_percent is not None
        assert check.before.marker_rmse_m is None


def test_without_a_calibrated_accelerometer_the_uncertainty_and_a_sentence_say_so(result, bare):
    known = result.feet["left"]
    for foot in bare.feet.values():
        assert any("calibrate it first" in each for each in foot.remarks())
        assert (foot.elements_std[3:] >= 0.003).all()
        assert foot.left_out == ()
    assert not any("calibrate it first" in each for each in known.remarks())
    assert np.allclose(known.elements_std, np.hypot(known.fit.elements_std, 0.0015))
    assert bare.checks == {}


def test_six_attitudes_leave_the_angles_of_the_accelerometer_open():
    given = {foot: accelerometer("scale") for foot in FEET}
    found = calibrate_walks([("corner", recording(5, "L"))], None, given, misalignment=0.01)
    assert any("10 mrad" in each for each in found.feet["right"].remarks())
    assert (found.feet["right"].elements_std[3:] >= 0.01).all()


def test_a_walk_that_cannot_be_used_is_named():
    walk = recording(5)
    short = Recording(walk.left[:200], walk.right[:200])
    with pytest.raises(CalibrationError, match="'short': "):
        calibrate_walks([("usual", walk), ("short", short)])


def test_the_pivot_takes_the_height_out_of_loops():
    config = TrackerConfig.from_mapping({"method": "zupt", "zupt.lever_back": 0.0})
    loops = [recording(5, speed=0.9), recording(5)]
    found = fit_pivot(loops, config, {})
    before, after = (np.abs(h).mean() for h in (found.heights_before, found.heights_after))
    assert after < 0.4 * before
    assert found.parameters() == {"zupt.lever_back": pytest.approx(found.lever_back, abs=1e-4)}
    assert found.paces and not found.lengths
    assert fit_pivot([Recording(loops[0].left, loops[0].right)], config, {}) is None
