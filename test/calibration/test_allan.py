"""The Allan deviation against published values, another package, closed forms; its slopes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.allan import allan_curve, overlapping, slopes_of


def nist():
    """Return the 1000 test values of NIST SP 1065 (2008), section 12.4."""
    values = [1234567890]
    for _ in range(999):
        values.append(16807 * values[-1] % 2147483647)
    return np.array(values) / 2147483647


def test_the_overlapping_deviation_is_that_of_the_handbook():
    published = [2.922319e-1, 9.159953e-2, 3.241343e-2]  # NIST SP 1065, table 31
    assert overlapping(nist(), 1.0, [1, 10, 100]) == pytest.approx(published, rel=1e-6)


def test_the_overlapping_deviation_is_that_of_allantools():
    allantools = pytest.importorskip(
        "allantools", reason="the cross-check needs the PyPI package allantools"
    )
    signal = np.cumsum(np.random.default_rng(0).standard_normal(4000)) * 0.01
    spans = [1, 2, 7, 30, 200]
    taus = [m / 50.0 for m in spans]
    _, theirs, _, _ = allantools.oadev(signal, rate=50.0, data_type="freq", taus=taus)
    assert overlapping(signal, 1 / 50.0, spans) == pytest.approx(theirs, rel=1e-9)


@given(slope=st.floats(1e-6, 1.0), interval=st.floats(1e-3, 1.0))
def test_a_ramp_rises_with_the_averaging_time_over_the_root_of_two(slope, interval):
    ramp = slope * np.arange(500) * interval
    spans = [1, 5, 50]
    expected = slope * np.array(spans) * interval / np.sqrt(2.0)
    assert overlapping(ramp, interval, spans) == pytest.approx(expected, rel=1e-6)


@settings(max_examples=20)
@given(factor=st.floats(-100.0, 100.0), offset=st.floats(-100.0, 100.0), seed=st.integers(0, 99))
def test_a_constant_does_not_matter_and_a_factor_is_a_factor(factor, offset, seed):
    signal = np.random.default_rng(seed).standard_normal(300)
    plain = overlapping(signal, 0.1, [1, 4, 30])
    scaled = overlapping(factor * signal + offset, 0.1, [1, 4, 30])
    assert scaled == pytest.approx(abs(factor) * plain, rel=1e-6, abs=1e-9)


def three(signal):
    return np.column_stack([signal] * 3)


def white(density, count, rate, seed=0):
    return density * np.sqrt(rate) * np.random.default_rng(seed).standard_normal(count)


@settings(max_examples=10, deadline=None)
@given(density=st.floats(1e-5, 1e-2), rate=st.sampled_from([50.0, 100.0, 200.0]))
def test_the_density_of_white_noise_is_found(density, rate):
    curve = allan_curve(three(white(density, 20000, rate)), 1.0 / rate)
    slopes = slopes_of(curve, 0)
    assert slopes.white == pytest.approx(density, rel=0.05)
    assert slopes.walk is None


def test_the_random_walk_of_a_bias_is_found():
    rate, count, drive = 10.0, 200000, 1e-4
    walk = np.cumsum(drive / np.sqrt(rate) * np.random.default_rng(1).standard_normal(count))
    slopes = slopes_of(allan_curve(three(walk + white(1e-3, count, rate)), 1 / rate), 1)
    assert slopes.white == pytest.approx(1e-3, rel=0.05)
    assert slopes.walk == pytest.approx(drive, rel=0.35)
    assert slopes.floor is not None


def test_pure_white_noise_shows_no_floor_for_chance():
    seen = [
        slopes_of(allan_curve(three(white(1e-3, 6000, 60.0, seed)), 1 / 60.0), 0).floor
        for seed in range(40)
    ]
    assert sum(floor is not None for floor in seen) <= 2


def test_the_told_error_is_the_scatter_of_the_deviation():
    curves = [allan_curve(white(1e-3, 3000, 60.0, seed)[:, None], 1 / 60.0) for seed in range(60)]
    deviations = np.array([c.deviation[:, 0] for c in curves])
    told = curves[0].relative_error
    scatter = deviations.std(axis=0) / deviations.mean(axis=0)
    assert (scatter < 1.3 * told).all()
    assert scatter[-1] > 0.4 * told[-1]


def test_no_time_is_longer_than_a_ninth_of_the_record():
    curve = allan_curve(three(white(1.0, 900, 1.0)), 1.0)
    assert curve.tau[0] == 1.0
    assert 80.0 <= curve.tau[-1] <= 100.0


def test_a_constant_signal_tells_nothing():
    slopes = slopes_of(allan_curve(np.ones((500, 3)), 0.01), 0)
    assert (slopes.white, slopes.floor, slopes.walk) == (None, None, None)


def test_too_few_samples_are_refused():
    with pytest.raises(CalibrationError, match="50 samples are too few"):
        allan_curve(np.zeros((50, 3)), 0.01)
