"""What is no measurement is refused with its own reason, and what is one is not."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.gyro import fit_gyro
from dualfoot_ros.calibration.soundness import doubts
from dualfoot_ros.calibration.sources import load_sources
from dualfoot_ros.calibration.static import segments_of
from dualfoot_ros.inspection.standstill import first_stand
from dualfoot_ros.inspection.stuck_values import held_at_rest
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import WalkConfig, grade, simulate

from .rest import export, joined, moving, resting


def accelerometer(series):
    return segments_of(series, "A")


def gyro(series):
    return fit_gyro([("A", series)])


def still(seconds=10.0):
    return resting([1, 0, 0.05], seconds)


def frozen():
    series = still()
    series.specific_force[:] = series.specific_force[0]
    series.angular_rate[:] = series.angular_rate[0]
    return series


def with_nan(every):
    series = still()
    series.specific_force[::every, 0] = np.nan
    return series


def exchanged():
    series = still()
    turned = np.radians(series.specific_force)
    return replace(series, specific_force=np.degrees(series.angular_rate), angular_rate=turned)


def stamped(factor):
    series = still()
    return replace(series, stamp_ns=((series.stamp_ns - 10**18) * factor).astype(np.int64))


def without_time():
    series = still()
    return replace(series, stamp_ns=np.full(len(series), 5))


@pytest.mark.parametrize("measure", [accelerometer, gyro])
@pytest.mark.parametrize(
    ("series", "sentence"),
    [
        (frozen(), r"'A': the sensor repeats itself \(specific force 9.\d+, .* m/s\^2, .* 100%"),
        (with_nan(7), r"'A': no standstill of 2 s .* 86 of 600 samples are not finite"),
        (with_nan(1), r"'A': 600 of 600 samples are not finite .* nothing is left"),
        (exchanged(), r"'A': .* angular rate 9.81 deg/s .* accelerometer and gyro .* exchanged"),
        (stamped(1e-3), r"'A': by its stamps it was sampled at 59998.8 Hz .* unit of the stamps"),
        (stamped(1e3), r"'A': by its stamps it was sampled at 0.06 Hz .* unit of the stamps"),
        (without_time(), r"'A': the stamps of its 600 samples do not increase"),
    ],
)
def test_what_is_no_measurement_is_refused_with_its_own_reason(measure, series, sentence):
    with pytest.raises(CalibrationError, match=sentence):
        measure(series)


@settings(max_examples=25, deadline=None)
@given(limit=st.floats(8.5, 9.8), sign=st.sampled_from([-1, 1]))
def test_an_axis_limited_at_rest_is_refused_with_its_value(limit, sign):
    series = resting([sign, 0, 0.01], 10.0)
    np.clip(series.specific_force, -limit, limit, out=series.specific_force)
    with pytest.raises(CalibrationError, match=rf"specific force x stays at {sign * limit:.4g} "):
        accelerometer(series)
    assert np.isfinite(gyro(series).bias).all()


@pytest.mark.parametrize("value", [0.0, 9.9])
def test_a_stuck_axis_is_refused_for_its_triad_and_a_warning_for_the_other(value):
    series = still()
    series.specific_force[:, 1] = value
    with pytest.raises(CalibrationError, match=f"specific force y stays at {value:.4g} m/s"):
        accelerometer(series)
    (doubt,) = doubts(series, "A", "gyro", [series])
    assert "specific force y stays" in doubt
    assert doubt.endswith("the gyro is not affected")
    assert list(doubts(series, "A", "accelerometer", [series])) == []


def test_a_triad_that_never_changes_is_refused_with_all_its_axes():
    series = still()
    series.angular_rate[:] = [0.01, 0.02, 0.03]
    with pytest.raises(CalibrationError, match=r"rate x, y, z stay at 0\.01, 0\.02, 0\.03 rad/s"):
        gyro(series)


def test_an_axis_stuck_between_attitudes_is_named_with_value_and_time():
    series = joined(still(), moving(20.0))
    series.angular_rate[:, 2] = 0.5
    with pytest.raises(
        CalibrationError, match=r"angular rate z is stuck .* \(at 0\.5 rad/s, first"
    ):
        accelerometer(series)


def test_some_samples_that_are_not_finite_are_left_out_and_said():
    series = still()
    series.specific_force[100:103, 1] = np.inf
    (segment,) = accelerometer(series)
    assert len(segment.samples) < 600
    assert np.isfinite(segment.mean).all()
    (doubt,) = doubts(series, "A", "accelerometer", [])
    assert "3 of 600 samples are not finite (nan or inf; the first is sample 100)" in doubt


def test_a_standstill_missed_because_of_the_gyro_says_so():
    series = still()
    series.angular_rate[:] += np.random.default_rng(0).normal(0, 0.1, (600, 3))
    with pytest.raises(CalibrationError, match=r"angular rate by 0\.\d+ rad/s, allowed is 0\.02"):
        accelerometer(series)


@settings(max_examples=40, deadline=None)
@given(force=st.floats(0.0, 0.1), rate=st.floats(0.0, 0.01), seed=st.integers(0, 99))
def test_a_coarse_sensor_that_is_noisy_is_no_stuck_one(force, rate, seed):
    series = resting([0, 1, 1], 10.0, noise=0.02, seed=seed)
    for values, resolution, noise in (
        (series.specific_force, force, 0.02),
        (series.angular_rate, rate, 0.001),
    ):
        step = min(resolution, 2.0 * noise)
        values[:] = np.round(values / step) * step if step > 1e-6 else values
    assert held_at_rest(series) == ()


def test_no_real_or_simulated_sensor_is_refused(dual_feet, tmp_path):
    files = sorted((dual_feet / "calibration").glob("*.csv"))
    for path in files:
        ((name, series),) = load_sources([path])["sensor"]
        assert segments_of(series, name)
        assert list(doubts(series, name, "gyro", [series])) == []
    walks = [import_recording(ImportOptions((p,))) for p in sorted(dual_feet.glob("*/*1.mat"))]
    walks += [simulate(WalkConfig(route="L"), grade(g), seed=1) for g in ("good", "consumer")]
    for walk in walks:
        for series in (walk.left, walk.right):
            stand = first_stand(series)
            seconds = (series.stamp_ns - series.stamp_ns[0]) * 1e-9
            at_rest = series[(seconds >= stand.start_s) & (seconds <= stand.end_s)]
            assert held_at_rest(at_rest) == ()


def test_the_file_is_named_as_it_was_given(tmp_path):
    path = export(tmp_path / "Axu.csv", frozen())
    ((name, series),) = load_sources([path])["sensor"]
    with pytest.raises(CalibrationError, match="'Axu': the sensor repeats itself"):
        segments_of(series, name)
