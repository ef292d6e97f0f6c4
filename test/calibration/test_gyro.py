"""Bias of a gyro with its uncertainty, and the noise parameters of the filter."""

import numpy as np
import pytest

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.gyro import fit_gyro
from dualfoot_ros.calibration.parameter_text import parameter_text
from dualfoot_ros.core import ImuSeries
from dualfoot_ros.settings.presets import load_config

from .rest import joined, moving, resting

RATE = 5.0


def long_rest(hours, *, gyro=1e-4, force=1e-3, drive=0.0, seed=0):
    """Return a sensor on a table with those noise densities and a walking bias."""
    rng = np.random.default_rng(seed)
    count = round(hours * 3600.0 * RATE)
    walk = np.cumsum(drive / np.sqrt(RATE) * rng.standard_normal((count, 3)), axis=0)
    return ImuSeries(
        np.arange(count) * round(1e9 / RATE),
        [0.0, 0.0, 9.8] + force * np.sqrt(RATE) * rng.standard_normal((count, 3)),
        walk + gyro * np.sqrt(RATE) * rng.standard_normal((count, 3)),
    )


def test_the_bias_is_within_its_uncertainty_as_often_as_it_should():
    true = np.array([0.01, -0.02, 0.03])
    fits = [fit_gyro([("a", resting([0, 0, 1], 20.0, gyro=true, seed=k))]) for k in range(60)]
    sigmas = np.array([(f.bias - true) / f.bias_std for f in fits])
    assert np.sqrt(np.mean(sigmas**2)) == pytest.approx(1.0, abs=0.3)


def test_the_longest_standstill_of_all_recordings_is_used():
    short, long = resting([0, 0, 1], 5.0), resting([1, 0, 0], 12.0, gyro=(0.02, 0, 0))
    fit = fit_gyro(
        [("a", short), ("b", joined(resting([0, 0, 1], 3.0), moving(), long, moving()))]
    )
    assert fit.standstill.duration_s == pytest.approx(12.0, abs=0.6)
    assert fit.bias[0] == pytest.approx(0.02, abs=0.001)


def test_hours_tell_what_drives_the_bias():
    fit = fit_gyro([("night", long_rest(8.0, gyro=1e-4, drive=2e-6))])
    noise = fit.noise(1800.0)
    assert noise["noise.gyro"] == pytest.approx(1e-4, rel=0.1)
    assert noise["noise.accelerometer"] == pytest.approx(1e-3, rel=0.1)
    assert noise["noise.gyro_bias"] == pytest.approx(2e-6, rel=0.5)
    assert "noise.accelerometer_bias" not in noise
    assert [s for s in fit.unseen() if s.startswith("gyro")] == []


def test_what_a_short_standstill_cannot_show_is_said_and_not_invented():
    fit = fit_gyro([("short", resting([0, 0, 1], 20.0))])
    assert set(fit.noise(1800.0)) == {"noise.gyro", "noise.accelerometer"}
    sentences = list(fit.unseen())
    assert len(sentences) == 2
    assert "too short for the bias instability" in sentences[0]


def test_the_parameters_are_a_file_that_the_tracker_takes(tmp_path):
    noise = fit_gyro([("night", long_rest(1.0))]).noise(1800.0)
    path = tmp_path / "noise.yaml"
    path.write_text(parameter_text(noise, ["measured"]))
    assert load_config(path).noise.gyro == pytest.approx(noise["noise.gyro"])


def test_a_sensor_that_turns_steadily_is_refused():
    with pytest.raises(CalibrationError, match=r"mean angular rate of z is 0\.5 rad/s"):
        fit_gyro([("table", resting([0, 0, 1], 20.0, gyro=(0, 0, 0.5)))])


def test_a_recording_without_standstill_is_refused():
    with pytest.raises(CalibrationError, match="'hand': no standstill"):
        fit_gyro([("hand", moving(10.0))])
