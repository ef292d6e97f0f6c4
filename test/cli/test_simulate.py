"""``dualfoot simulate`` as a user meets it."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.cli.main import main
from dualfoot_ros.core import Increments
from dualfoot_ros.evaluation.frames.association import truth_at
from dualfoot_ros.recording import read_bag
from dualfoot_ros.simulation import ROUTES, SensorConfig, WalkConfig, simulate

ROOT = Path(__file__).resolve().parents[2]
SHORT = ["--route", "L", "--rate", "60", "--standing", "2"]


def refusal(arguments, capsys):
    """Return the sentence on standard error of a command that must end with exit code 2."""
    assert main(["simulate", *arguments]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.startswith("dualfoot simulate: error: ")
    return streams.err


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_bag_holds_what_the_library_simulates(tmp_path, storage, capsys):
    path = str(tmp_path / "walk")
    assert main(["simulate", "-o", path, *SHORT, "--seed", "4", "--storage", storage]) == 0
    assert "L, 52 m in" in capsys.readouterr().out
    recording = read_bag(path)
    made = simulate(WalkConfig(route="L", rate=60.0, standing=2.0), SensorConfig(), seed=4)
    np.testing.assert_array_equal(recording.left.specific_force, made.left.specific_force)
    np.testing.assert_array_equal(recording.right.stamp_ns, made.right.stamp_ns)
    np.testing.assert_array_equal(recording.left_truth.position, made.left_truth.position)
    np.testing.assert_allclose(
        recording.right_truth.velocity, made.right_truth.velocity, atol=1e-12
    )
    assert recording.notes["route"] == "L, 1 x, seed 4"


def test_thinned_truth_still_gives_the_position_between_to_a_millimetre(tmp_path):
    path = str(tmp_path / "walk")
    assert main(["simulate", "-o", path, "--route", "L", "--truth-rate", "25"]) == 0
    made = simulate(WalkConfig(route="L"), SensorConfig(), seed=0)
    thin = read_bag(path).left_truth
    assert len(thin) < 0.26 * len(made.left_truth)
    between = truth_at(made.left_truth.stamp_ns, thin)
    np.testing.assert_allclose(between.position, made.left_truth.position, atol=2e-3)
    error = np.sqrt(np.mean((between.position - made.left_truth.position) ** 2))
    assert error < 2e-4


def test_json_is_one_object_and_nothing_else(tmp_path, capsys):
    path = str(tmp_path / "walk")
    assert main(["simulate", "-o", path, *SHORT, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["bag"] == path
    assert facts["passes"] > 50
    assert 0.1 < facts["min_distance_mean_m"] < 0.2


def test_the_list_names_every_route_and_parameter(capsys):
    assert main(["simulate", "--list"]) == 0
    text = capsys.readouterr().out
    for name in (
        *ROUTES,
        "gait.kappa",
        "sensor.g_sensitivity",
        "left_clock.drift",
        "barometer.noise",
        "magnetometer.hard_iron",
    ):
        assert name in text
    assert main(["simulate", "--list", "--json"]) == 0
    assert set(json.loads(capsys.readouterr().out)["routes"]) == set(ROUTES)


def test_parameters_of_every_group_can_be_set(tmp_path):
    path = str(tmp_path / "walk")
    settings = [
        "gait.min_distance=0.2",
        "sensor.accelerometer_bias=0",
        "right_clock.offset=5.0",
        "stops=1",
    ]
    arguments = [word for text in settings for word in ("--set", text)]
    assert main(["simulate", "-o", path, *SHORT, *arguments]) == 0
    recording = read_bag(path)
    assert recording.right.stamp_ns[0] - recording.left.stamp_ns[0] == 5_000_000_000
    assert recording.notes["min_distance_m"] == "0.2"


@pytest.mark.parametrize(
    ("option", "worn"),
    [
        (["--barometer"], {"left", "right"}),
        (["--barometer", "feet"], {"left", "right"}),
        (["--barometer", "body"], {"both"}),
        ([], set()),
    ],
)
def test_air_pressure_is_written_where_a_barometer_is_worn(tmp_path, option, worn, capsys):
    path = str(tmp_path / "walk")
    rate = ["--set", "barometer.rate=10"] if worn else []
    assert main(["simulate", "-o", path, *SHORT, *option, *rate]) == 0
    said = capsys.readouterr().out
    pressure = read_bag(path).pressure
    assert set(pressure) == worn
    for where, series in pressure.items():
        assert f"{len(series)} samples of air pressure, worn on {where}" in said
        assert np.diff(series.stamp_ns).tolist() == [100_000_000] * (len(series) - 1)


def test_the_magnetic_field_is_written_where_it_is_asked_for(tmp_path, capsys):
    path, bare = str(tmp_path / "walk"), str(tmp_path / "bare")
    given = ["--magnetometer", "--set", "magnetometer.field=50", "--set", "magnetometer.noise=0"]
    assert main(["simulate", "-o", path, *SHORT, *given]) == 0
    assert "every sample has the magnetic field" in capsys.readouterr().out
    field = read_bag(path).right.magnetic_field
    assert np.linalg.norm(field, axis=1) == pytest.approx(50e-6, rel=0.1)
    assert main(["simulate", "-o", bare, *SHORT]) == 0
    assert read_bag(bare).right.magnetic_field is None


def test_two_sensors_on_one_shoe_keep_their_distance(tmp_path):
    path = str(tmp_path / "board")
    assert main(["simulate", "-o", path, *SHORT, "--one-shoe", "0.05"]) == 0
    recording = read_bag(path)
    apart = recording.left_truth.position - recording.right_truth.position
    np.testing.assert_allclose(np.linalg.norm(apart, axis=1), 0.05, atol=1e-9)


def test_the_lever_arm_of_two_sensors_on_one_shoe_is_told_in_the_axes_of_the_first(
    tmp_path, capsys
):
    path = str(tmp_path / "board")
    assert main(["simulate", "-o", path, *SHORT, "--one-shoe", "0.05", "--json"]) == 0
    arm = np.array(json.loads(capsys.readouterr().out)["lever_arm_m"])
    recording = read_bag(path)
    turn = Rotation.from_quat(recording.left_truth.quaternion)
    apart = recording.right_truth.position - recording.left_truth.position
    np.testing.assert_allclose(turn.inv().apply(apart), np.tile(arm, (len(apart), 1)), atol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--route", "moon"], ("route", "moon", "rectangle")),
        (["--rate", "1000"], ("rate", "1000", "[60, 400] Hz")),
        (["--grade", "best"], ("grade", "best", "consumer")),
        (["--route", "city", "--laps", "2"], ("laps is 2", "open")),
        (["--stops", "500"], ("stops is 500", "allowed is 0 to")),
        (["--seed", "-1"], ("--seed is -1", "from 0")),
        (["--truth-rate", "0"], ("--truth-rate is 0", "more than 0 Hz")),
        (["--one-shoe", "2"], ("separation is 2 m", "0.3 m")),
        (["--barometer", "hat"], ("barometer.worn", "hat", "feet, body")),
        (["--set", "barometer.noise=1"], ("barometer.noise", "add --barometer")),
        (["--set", "magnetometer.dip=1"], ("magnetometer.dip", "add --magnetometer")),
        (["--magnetometer", "--set", "magnetometer.dip=9"], ("magnetometer.dip", "1.5] rad")),
        (["--barometer", "--set", "barometer.noise=-1"], ("barometer.noise", "-1", "[0, 100] Pa")),
        (["--set", "gait.kapa=0.5"], ("gait.kapa", "kappa")),
        (["--set", "sensor.gyro_noise=much"], ("sensor.gyro_noise", "much")),
        (["--set", "gait=3"], ("gait", "group")),
        (["--set", "kappa"], ("KEY=VALUE",)),
    ],
)
def test_what_cannot_be_simulated_is_refused_by_name_and_nothing_is_written(
    arguments, words, tmp_path, capsys
):
    path = tmp_path / "walk"
    said = refusal(["-o", str(path), *arguments], capsys)
    for word in words:
        assert word in said
    assert list(tmp_path.iterdir()) == []


def test_without_an_output_it_says_how_to_give_one(capsys):
    assert "-o BAG" in refusal([], capsys)


def test_an_existing_bag_is_kept_unless_told_otherwise(tmp_path, capsys):
    path = str(tmp_path / "walk")
    assert main(["simulate", "-o", path, *SHORT]) == 0
    before = {p.name: p.read_bytes() for p in Path(path).iterdir()}
    capsys.readouterr()
    assert path in refusal(["-o", path, *SHORT, "--seed", "9"], capsys)
    assert {p.name: p.read_bytes() for p in Path(path).iterdir()} == before
    assert main(["simulate", "-o", path, *SHORT, "--seed", "9", "--overwrite"]) == 0


def test_help_has_examples_and_the_process_ends_with_zero():
    command = [sys.executable, "-m", "dualfoot_ros", "simulate", "--help"]
    done = subprocess.run(
        command, check=False, capture_output=True, text=True, timeout=120, cwd=ROOT
    )
    assert done.returncode == 0
    assert "dualfoot simulate -o walk" in done.stdout


def test_the_samples_of_a_simulated_bag_are_of_the_kind_asked_for(tmp_path):
    assert (
        main(["simulate", "-o", str(tmp_path / "dots"), *SHORT, "--increments", "compensated"])
        == 0
    )
    assert read_bag(tmp_path / "dots").right.increments is Increments.COMPENSATED


def test_the_demo_bag_is_what_the_script_makes(tmp_path):
    spec = importlib.util.spec_from_file_location("make_bags", ROOT / "scripts" / "make_bags.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    assert script.make(tmp_path) == 0
    for name in script.BAGS:
        fresh, kept = read_bag(tmp_path / name), read_bag(ROOT / "bags" / name)
        for foot in ("left", "right"):
            one, other = getattr(fresh, foot), getattr(kept, foot)
            np.testing.assert_array_equal(one.stamp_ns, other.stamp_ns)
            assert one.increments is other.increments is Increments.AVERAGED
            # A last bit of the motion may round to the next step of a quantised sample.
            np.testing.assert_allclose(one.specific_force, other.specific_force, atol=5e-3)
            np.testing.assert_allclose(one.angular_rate, other.angular_rate, atol=1.1e-3)
            truth = getattr(fresh, f"{foot}_truth").position
            np.testing.assert_allclose(truth, getattr(kept, f"{foot}_truth").position, atol=1e-6)
