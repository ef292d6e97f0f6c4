"""Bias, scale and misalignment: recovered where the attitudes tell them, refused where not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.calibration import CalibrationError
from dualfoot_ros.calibration.accelerometer import MODELS, fit_accelerometer, rms, why_not
from dualfoot_ros.calibration.cross_validation import cross_validate
from dualfoot_ros.calibration.sources import load_sources
from dualfoot_ros.calibration.static import segments_of
from dualfoot_ros.inspection.standstill import first_stand
from dualfoot_ros.recording.importers import ImportOptions, import_recording

from .rest import GRAVITY, SIX, segments, well_spread

small = st.floats(-0.02, 0.02)
biases = st.tuples(*[st.floats(-0.3, 0.3)] * 3)


def lower(values):
    """Return a lower triangular matrix: scale errors, then xy, xz, yz."""
    matrix = np.diag(1.0 + np.array(values[:3]))
    matrix[[1, 2, 2], [0, 0, 1]] = values[3:]
    return matrix


@settings(max_examples=12, deadline=None)
@given(bias=biases, errors=st.tuples(*[small] * 6))
def test_bias_scale_and_misalignment_are_recovered_from_many_attitudes(bias, errors):
    fit = fit_accelerometer(segments(well_spread(20), bias=bias, matrix=lower(errors)))
    assert fit.model == "full"
    assert np.allclose(fit.bias, bias, atol=0.005)
    assert np.allclose(fit.matrix, lower(errors), atol=0.001)
    assert rms(fit.residual_after) < 0.003


@settings(max_examples=12, deadline=None)
@given(bias=biases, scale=st.tuples(*[small] * 3))
def test_six_positions_give_bias_and_scale_even_if_they_are_not_quite_level(bias, scale):
    tilt = np.random.default_rng(1).normal(0.0, 0.02, (6, 3))
    matrix = lower([*scale, 0, 0, 0])
    fit = fit_accelerometer(segments(SIX + tilt, bias=bias, matrix=matrix))
    assert (fit.model, fit.redundancy) == ("scale", 0)
    assert np.allclose(fit.bias, bias, atol=0.005)
    assert np.allclose(fit.matrix, matrix, atol=0.001)


def test_six_positions_do_not_tell_the_misalignment():
    assert "misalignment need at least 9 attitudes" in why_not(
        segments(SIX), MODELS["full"], GRAVITY
    )
    nine = np.vstack([SIX, SIX[:3] + 0.3 * np.roll(np.eye(3), 1, axis=0)])
    reason = why_not(segments(nine), MODELS["full"], GRAVITY)
    assert "the misalignment of" in reason


def test_attitudes_in_one_plane_are_refused_however_many_they_are():
    angles = np.radians(np.arange(0, 360, 30))
    ups = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(12)])
    with pytest.raises(CalibrationError, match=r"do not determine the (bias|scale) of"):
        fit_accelerometer(segments(ups))


@pytest.mark.parametrize(
    ("ups", "sentence"),
    [
        (SIX[:1], r"1 different attitude is too few.*missing: x down, y up"),
        (SIX[:5], r"5 different attitudes are too few.*missing: z down$"),
        (np.vstack([SIX[:4]] * 3), "4 different attitudes"),
    ],
)
def test_too_few_attitudes_are_refused_and_what_is_missing_is_named(ups, sentence):
    with pytest.raises(CalibrationError, match=sentence):
        fit_accelerometer(segments(ups))


def test_an_attitude_that_was_recorded_often_counts_once():
    often = np.vstack([SIX, [SIX[0]] * 10])
    fit = fit_accelerometer(segments(often, bias=(0.1, 0.0, 0.0)))
    assert fit.attitudes == 6
    assert fit.bias_std[0] == pytest.approx(fit.bias_std[1], rel=0.05)


def test_the_standard_deviation_of_the_bias_is_the_scatter_of_the_bias():
    rng = np.random.default_rng(3)
    ups = well_spread(16)
    found, told = [], []
    for _ in range(30):
        disturbed = [rng.normal(0.0, 0.02) for _ in ups]
        parts = segments(ups)
        for part, error in zip(parts, disturbed, strict=True):
            part.samples[:] += error * part.direction
        fit = fit_accelerometer(parts)
        found.append(fit.bias)
        told.append(fit.bias_std)
    assert np.std(found) == pytest.approx(np.mean(told), rel=0.25)


def test_the_result_does_not_depend_on_which_gravity_is_meant_but_for_the_scale():
    parts = segments(SIX, bias=(0.1, -0.2, 0.3))
    here, there = fit_accelerometer(parts), fit_accelerometer(parts, gravity=9.83)
    assert np.allclose(here.bias, there.bias, atol=1e-4)
    assert np.allclose(
        there.matrix / here.matrix.trace() * 3.0, np.eye(3) * 9.83 / GRAVITY, atol=1e-3
    )


def test_what_was_left_out_is_predicted():
    errors = {"bias": (0.1, -0.05, 0.2), "matrix": lower([0.01, -0.01, 0.005, 0.01, 0.0, -0.01])}
    parts = segments(well_spread(20), **errors)
    check = cross_validate(parts, fit_accelerometer(parts))
    assert check.how == "attitude"
    assert check.after < 0.05 * check.before
    six = segments(SIX, **errors)
    assert cross_validate(six, fit_accelerometer(six)).how == "half"


def test_a_model_that_is_too_small_leaves_residuals():
    parts = segments(SIX, bias=(0.1, 0.0, 0.0), matrix=lower([0.01, 0.0, -0.01, 0, 0, 0]))
    fit = fit_accelerometer(parts, "bias")
    assert fit.redundancy == 3
    assert 0.03 < rms(fit.residual_after) < rms(fit.residual_before)


@pytest.fixture(scope="module")
def stands(dual_feet):
    """Return the mean specific force of every walk's stand, by foot."""
    walks = [
        p
        for d in ("rectangle_ccw", "rectangle_cw", "figure_eight", "running_track")
        for p in sorted((dual_feet / d).glob("*.mat"))
    ]
    found = {"left": [], "right": []}
    for path in walks:
        recording = import_recording(ImportOptions(sources=(path,)))
        for foot, forces in found.items():
            forces.append(first_stand(recording.imu(foot)).specific_force)
    return {foot: np.array(forces) for foot, forces in found.items()}


@pytest.mark.parametrize(
    ("foot", "letter", "before", "limit"),
    [("right", "A", 0.033, 0.015), ("left", "B", 0.105, 0.03)],
)
def test_real_six_positions_correct_the_stands_of_other_days(
    dual_feet, stands, foot, letter, before, limit
):
    paths = sorted((dual_feet / "calibration").glob(f"{letter}*.csv"))
    (named,) = load_sources(paths, foot).values()
    parts = [s for name, series in named for s in segments_of(series, name)]
    fit = fit_accelerometer(parts)
    assert (len(parts), fit.attitudes, fit.model) == (6, 6, "scale")
    assert rms(fit.residual_before) == pytest.approx(before, abs=0.001)
    as_measured = np.linalg.norm(stands[foot], axis=1) - GRAVITY
    assert rms(fit.residuals(stands[foot])) < min(limit, 0.5 * rms(as_measured))
