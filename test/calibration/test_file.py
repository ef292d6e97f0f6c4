"""Calibration files: what is written is read, what cannot be is refused with a sentence."""

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.calibration import (
    Calibration,
    CalibrationError,
    SensorCalibration,
    Triad,
    calibrated,
    for_feet,
    sensor_calibration,
)
from dualfoot_ros.recording import Recording

from .rest import resting

numbers = st.floats(-0.4, 0.4)


def triad(bias=(0.1, -0.2, 0.3), scale=1.01):
    return Triad(np.array(bias), scale * np.eye(3))


@given(
    bias=st.tuples(numbers, numbers, numbers),
    beside=st.lists(numbers, min_size=9, max_size=9),
    name=st.sampled_from(["left", "right", "sensor"]),
    kind=st.sampled_from(["accelerometer", "gyro"]),
)
def test_what_is_written_is_read(tmp_path_factory, bias, beside, name, kind):
    matrix = np.eye(3) + np.reshape(beside, (3, 3)) * 0.9
    path = tmp_path_factory.mktemp("files") / "a.yaml"
    found = Triad(np.array(bias), matrix, {"model": "full", "attitudes": 20})
    Calibration().with_triad(name, kind, found).save(path)
    read = getattr(Calibration.load(path).sensors[name], kind)
    assert np.allclose(read.bias, bias, atol=1e-8)
    assert np.allclose(read.matrix, matrix, atol=1e-8)
    assert read.about == found.about


def test_another_triad_and_another_foot_are_added_and_nothing_is_lost():
    both = Calibration().with_triad("left", "accelerometer", triad())
    both = both.with_triad("left", "gyro", triad()).with_triad("right", "gyro", triad())
    assert list(both.sensors["left"].triads()) == ["accelerometer", "gyro"]
    assert list(both.sensors["right"].triads()) == ["gyro"]


def test_a_series_and_its_samples_one_by_one_are_corrected_alike():
    series = resting([1, 2, 3], 1.0)
    matrix = np.eye(3) + 0.01 * np.arange(9.0).reshape(3, 3)
    sensor = SensorCalibration(Triad(np.array([0.1, 0.2, 0.3]), matrix), triad())
    whole = sensor.apply(series)
    for k in range(5):
        sample = np.hstack([series.specific_force[k], series.angular_rate[k]])
        expected = np.hstack([whole.specific_force[k], whole.angular_rate[k]])
        assert np.allclose(sensor.values(sample), expected, rtol=0, atol=1e-12)


def test_correcting_undoes_the_errors_of_the_sensor():
    bias, matrix = (
        np.array([0.1, -0.2, 0.05]),
        np.array([[1.01, 0, 0], [0.02, 0.98, 0], [0, 0, 1]]),
    )
    series = resting([1, -1, 2], 1.0, bias=bias, matrix=matrix, noise=0.0)
    corrected = SensorCalibration(Triad(bias, matrix)).apply(series)
    assert np.allclose(np.linalg.norm(corrected.specific_force, axis=1), 9.80665, atol=1e-9)
    assert corrected.angular_rate is series.angular_rate


def test_the_feet_of_a_recording_are_corrected_each_by_its_own():
    left, right = resting([0, 0, 1], 1.0), resting([0, 0, 1], 1.0)
    done = calibrated(Recording(left, right), {"left": SensorCalibration(triad())})
    assert not np.allclose(done.left.specific_force, left.specific_force)
    assert done.right is right


GOOD = {"format": "dualfoot_calibration", "version": 1}
MATRIX = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def document(**accelerometer):
    return {**GOOD, "calibration": {"left": {"accelerometer": accelerometer}}}


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ([], "it is \\[\\]; allowed is a mapping"),
        ({**GOOD, "format": "x", "calibration": {}}, "format is 'x'; allowed is dualfoot"),
        ({**GOOD, "version": 2, "calibration": {}}, "version is 2; allowed is 1"),
        (GOOD, "calibration is None; allowed is a mapping with left, right, sensor"),
        ({**GOOD, "calibration": {}}, "calibration is {}; allowed is at least one of left"),
        ({**GOOD, "calibration": {"middle": {}}}, "unknown key 'middle'.*known: left, right"),
        (
            {**GOOD, "calibration": {"left": {"gyros": {}}}},
            "unknown key 'gyros' in calibration.left",
        ),
        (document(), r"calibration.left.accelerometer.bias is None; allowed is three numbers"),
        (document(bias=[1, 2]), r"bias is \[1, 2\]; allowed is three numbers in \[-5, 5\] m/s"),
        (document(bias=[0, 0, 9.8]), r"bias is \[0, 0, 9.8\]"),
        (document(bias=[0, 0, float("nan")]), r"bias is \[0, 0, nan\]"),
        (document(bias=[0, 0, True]), "bias is"),
        (
            document(bias=[0, 0, 0], matrix=[1, 1, 1]),
            r"matrix is \[1, 1, 1\]; allowed is three rows",
        ),
        (document(bias=[0, 0, 0], matrix=MATRIX[:2]), "matrix is"),
        (document(bias=[0, 0, 0], matrix=[[1, 0], [0, 1], [0, 0, 1]]), "matrix is"),
        (document(bias=[0, 0, 0], matrix=[[9.8, 0, 0], *MATRIX[1:]]), "on the diagonal in"),
        (document(bias=[0, 0, 0], about=3), "about is 3; allowed is a mapping"),
    ],
)
def test_what_is_no_calibration_is_refused_naming_key_value_and_what_is_allowed(
    tmp_path, content, sentence
):
    path = tmp_path / "bad.yaml"
    path.write_text(yaml.safe_dump(content))
    with pytest.raises(CalibrationError, match=sentence):
        Calibration.load(path)


def test_text_that_is_no_yaml_is_refused(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_bytes(b"a: [1,\n\xff")
    with pytest.raises(CalibrationError, match="is no YAML"):
        Calibration.load(path)


@pytest.fixture
def files(tmp_path):
    """Return a file for both feet, one for the left foot, and one that names no foot."""
    both = Calibration().with_triad("left", "gyro", triad()).with_triad("right", "gyro", triad())
    both.save(tmp_path / "both.yaml")
    Calibration().with_triad("left", "gyro", triad()).save(tmp_path / "left.yaml")
    Calibration().with_triad("sensor", "gyro", triad()).save(tmp_path / "any.yaml")
    return {name: str(tmp_path / f"{name}.yaml") for name in ("both", "left", "any")}


def test_files_are_put_on_their_feet(files):
    assert set(for_feet([files["both"]])) == {"left", "right"}
    assert set(for_feet([f"right={files['any']}"])) == {"right"}
    assert set(for_feet([files["left"], f"right={files['both']}"])) == {"left", "right"}
    assert sensor_calibration(files["any"], "right").gyro is not None


def test_a_file_without_a_foot_a_foot_twice_and_a_foot_that_is_not_there_are_refused(files):
    with pytest.raises(CalibrationError, match=r"names no foot.*left="):
        for_feet([files["any"]])
    with pytest.raises(CalibrationError, match="two calibrations are given for the left foot"):
        for_feet([files["both"], files["left"]])
    with pytest.raises(CalibrationError, match="is for left; it has none for right"):
        sensor_calibration(files["left"], "right")
