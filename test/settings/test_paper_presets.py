"""Presets are the papers' methods; with paper noise they hold the papers' numbers too."""

import math

import pytest

from dualfoot_ros.core import ConfigError, Increments, TrackerConfig, method_parameters
from dualfoot_ros.core.constraints.step_length import step_length
from dualfoot_ros.settings.files import read_parameters
from dualfoot_ros.settings.presets import find_config, load_config, paper_noise_file

PAPERS = ("liu2023", "ma2023_vdc", "ma2023_svc", "chen2024", "chen2022")
DEG_PER_HOUR = math.radians(1.0) / 3600.0


@pytest.mark.parametrize("name", PAPERS)
def test_no_paper_has_the_pivot_the_longer_stand_or_the_drift_of_the_height(name):
    zupt = load_config(name).zupt
    assert (zupt.lever_arm, zupt.rate_std, zupt.height_drift) == (0.0, 0.0, 0.0)
    assert zupt.still_after >= 1e6


@pytest.mark.parametrize("name", PAPERS)
def test_no_paper_looks_for_floors_that_move(name):
    assert not load_config(name).floor.watch


@pytest.mark.parametrize("name", PAPERS)
def test_every_paper_keeps_the_two_sample_terms_whatever_the_source_says(name):
    increments = load_config(name).increments
    for foot in ("left", "right"):
        assert increments.of(foot, Increments.COMPENSATED) is Increments.AVERAGED


@pytest.mark.parametrize("name", ("ma2023_vdc", "ma2023_svc"))
def test_ma_and_sarkka_have_no_biases_a_flat_floor_and_the_heading_of_the_first_stride(name):
    config = load_config(name, paper_noise=True)
    assert (config.noise.gyro_bias, config.noise.accelerometer_bias) == (0.0, 0.0)
    assert (config.initial.gyro_bias, config.initial.accelerometer_bias) == (0.0, 0.0)
    assert config.aids.flat_floor
    # R = diag(0.01 I, 0.0001 I), variances
    assert config.aids.static_std**2 == pytest.approx(0.01)
    assert config.zupt.std**2 == pytest.approx(0.0001)
    assert (config.heading.from_stance, config.heading.to_stance) == (0, 1)


def test_varying_distance_has_sigma_five_samples_at_60_hz():
    config = load_config("ma2023_vdc", paper_noise=True)
    assert config.method == "varying_distance"
    assert config.constraint.sigma * 60.0 == pytest.approx(5.0, abs=0.01)
    assert config.constraint.minimum == 0.2


def test_spacing_vector_is_the_hard_projection_of_both_components():
    config = load_config("ma2023_svc", paper_noise=True)
    svc = config.constraint
    assert config.method == "spacing_vector"
    assert (svc.height_std, svc.heading_correction) == (0.0, "full")
    assert (svc.spacing, svc.spacing_std, svc.variant) == (0.2, 0.0, "vector")


def test_chen_liu_guo_have_the_bound_of_their_subject_and_the_sensors_of_table_2():
    config = load_config("chen2024", paper_noise=True)
    assert config.method == "step_length" and config.aids.barometer
    assert config.constraint.threshold_m == 1.2
    assert step_length(config.constraint.body_height) == pytest.approx(1.207, abs=1e-3)
    assert config.noise.gyro == pytest.approx(math.radians(5e-3), rel=1e-3)
    assert config.noise.accelerometer == pytest.approx(60e-6 * 9.80665, rel=1e-3)
    assert config.initial.gyro_bias == pytest.approx(3.0 * DEG_PER_HOUR, rel=1e-3)
    drive = config.initial.gyro_bias * math.sqrt(2.0 / config.noise.bias_time)
    assert config.noise.gyro_bias == pytest.approx(drive, rel=1e-3)


def test_chen_et_al_2022_have_positions_and_velocities_as_the_only_states():
    config = load_config("chen2022")
    assert config.method == "rigid_pair"
    right, front, up = 0.01, 0.01, 0.0
    assert config.constraint.lever_arm == (front, -right, up)
    noise, start = config.noise, config.initial
    assert noise.accelerometer > 0.0
    assert (noise.gyro, noise.gyro_bias, noise.accelerometer_bias) == (0.0, 0.0, 0.0)
    assert (start.tilt, start.yaw, start.gyro_bias, start.accelerometer_bias) == (0.0,) * 4


@pytest.mark.parametrize("name", PAPERS)
def test_every_preset_keeps_the_equations_of_its_paper(name):
    config = load_config(name)
    assert config.increments.left == config.increments.right == "averaged"
    assert config.stance.detector == "fixed"
    assert config.zupt.heading_correction == "full"


@pytest.mark.parametrize("name", ("liu2023", "ma2023_vdc", "ma2023_svc", "chen2024"))
def test_noise_bias_and_spacing_are_the_users_unless_those_of_the_paper_are_asked_for(name):
    usual, config = TrackerConfig(), load_config(name)
    assert config.noise == usual.noise and config.initial == usual.initial
    assert config.zupt.std == usual.zupt.std
    of_gait = ("distance", "distance_std", "kappa", "spacing", "spacing_std", "minimum", "maximum")
    default = method_parameters(config.method)()
    for key in of_gait:
        assert getattr(config.constraint, key, None) == getattr(default, key, None), key
    assert load_config(name, paper_noise=True) != config


@pytest.mark.parametrize("name", ("liu2023", "ma2023_vdc", "ma2023_svc", "chen2024"))
def test_the_noise_of_a_paper_leaves_its_method_alone(name):
    of_noise = set(read_parameters(paper_noise_file(name)))
    assert not of_noise & set(read_parameters(find_config(name)))
    assert all(not key.endswith(("method", "solver", "variant", "moment")) for key in of_noise)


@pytest.mark.parametrize("name", (None, "default", "chen2022", "mine.yaml"))
def test_the_noise_of_a_paper_is_refused_where_there_is_none(name):
    with pytest.raises(
        ConfigError, match=r"noise of a paper is asked for with .*chen2024, liu2023"
    ):
        paper_noise_file(name)
