"""``dualfoot calibrate`` as a user meets it."""

import errno
import json
import os

import numpy as np
import pytest
import yaml
from calibration.rest import SIX, export, joined, moving, resting

from dualfoot_ros.calibration import Calibration, SensorCalibration, Triad
from dualfoot_ros.cli.main import main
from dualfoot_ros.core import ImuSeries
from dualfoot_ros.recording import Recording, write_bag
from dualfoot_ros.simulation import MagnetometerConfig, WalkConfig, simulate

BIAS = (0.1, -0.05, 0.2)


@pytest.fixture(scope="module")
def six(tmp_path_factory):
    """Return the exports of six positions."""
    folder = tmp_path_factory.mktemp("six")
    return [
        str(export(folder / f"{k}.csv", resting(up, bias=BIAS, seed=k)))
        for k, up in enumerate(SIX)
    ]


@pytest.fixture(scope="module")
def tumbled(tmp_path_factory):
    """Return a bag in which both sensors were turned from side to side."""
    parts = [part for up in SIX for part in (resting(up, bias=BIAS), moving())]
    path = tmp_path_factory.mktemp("bags") / "tumbled"
    write_bag(path, Recording(joined(*parts), joined(*parts)))
    return str(path)


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    """Return 50 s of walks as bags: a figure of eight, the same exchanged, a straight line."""
    folder = tmp_path_factory.mktemp("walks")
    for route, names in (("figure_eight", ("eight", "exchanged")), ("straight", ("line",))):
        made = simulate(WalkConfig(route=route, rate=60.0, standing=5.0), seed=1)
        feet = made.left[:3000], made.right[:3000]
        for name, order in zip(names, (feet, feet[::-1]), strict=False):
            write_bag(folder / name, Recording(*order))
    return {name: str(folder / name) for name in ("eight", "exchanged", "line")}


def test_walks_give_gyro_matrices_beside_the_accelerometers_that_are_there(bags, tmp_path, capsys):
    target = tmp_path / "both.yaml"
    triad = Triad(np.zeros(3), np.eye(3), {"model": "full"})
    Calibration({"left": SensorCalibration(accelerometer=triad)}).save(target)
    assert main(["calibrate", "walk", bags["eight"], "-o", str(target), "--json"]) == 0
    printed = capsys.readouterr()
    facts = json.loads(printed.out)
    assert facts["left"]["self_test_passed"] and facts["walks"] == ["eight"]
    assert "right: the accelerometer is not calibrated; calibrate it first" in printed.err
    assert "left: the accelerometer is not calibrated" not in printed.err
    found = Calibration.load(target).sensors
    assert found["left"].accelerometer is not None and found["right"].accelerometer is None
    assert np.allclose(found["right"].gyro.matrix, facts["right"]["matrix"], atol=1e-8)


def test_a_walk_that_is_no_loop_gives_no_pivot(bags, tmp_path, capsys):
    target = tmp_path / "pivot.yaml"
    assert main(["calibrate", "walk", bags["eight"], "--parameters", str(target)]) == 2
    assert "no walk is a loop by its reference.yaml" in capsys.readouterr().err
    assert not target.exists()


def test_a_misalignment_out_of_range_is_refused(bags, capsys):
    assert main(["calibrate", "walk", bags["eight"], "--misalignment", "2"]) == 2
    assert "--misalignment is 2; allowed is 0 to 0.1 rad" in capsys.readouterr().err


def test_six_exports_become_a_calibration_file_with_a_figure_beside_it(six, tmp_path, capsys):
    target = tmp_path / "right.yaml"
    assert main(["calibrate", "accelerometer", *six, "--foot", "right", "-o", str(target)]) == 0
    out = capsys.readouterr().out
    for words in ("bias and scale from 6 standstills", "before", "cross-validation", str(target)):
        assert words in out
    assert "proves nothing" in out
    found = Calibration.load(target).sensors["right"].accelerometer
    assert np.allclose(found.bias, BIAS, atol=0.01)
    assert {p.name for p in tmp_path.iterdir()} == {
        "right.yaml",
        "right_accelerometer.png",
    }


def test_recordings_of_two_sensors_for_one_are_doubted(six, tmp_path, capsys):
    others = [
        str(export(tmp_path / f"{k}.csv", resting(up, bias=(-0.2, 0.1, 0.0), seed=k)))
        for k, up in enumerate(SIX)
    ]
    assert main(["calibrate", "accelerometer", *six, *others]) == 0
    captured = capsys.readouterr()
    assert "were all recordings of the same sensor" in captured.err
    assert "proves nothing" not in captured.out


def test_a_file_that_is_there_is_added_to(six, tmp_path, capsys):
    target = str(tmp_path / "both.yaml")
    common = ["-o", target, "--no-plots"]
    assert main(["calibrate", "accelerometer", *six, "--foot", "right", *common]) == 0
    assert main(["calibrate", "accelerometer", *six, "--foot", "left", *common]) == 0
    assert main(["calibrate", "gyro", six[0], "--foot", "left", *common]) == 0
    sensors = Calibration.load(target).sensors
    assert list(sensors["left"].triads()) == ["accelerometer", "gyro"]
    assert list(sensors["right"].triads()) == ["accelerometer"]


def test_a_bag_calibrates_both_sensors_and_evaluate_takes_the_file(
    tumbled, bags, tmp_path, capsys
):
    target = str(tmp_path / "both.yaml")
    assert main(["calibrate", "accelerometer", tumbled, "-o", target, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["left"]["attitudes"] == 6
    assert facts["right"]["cross_validation"]["how"] == "half"
    evaluate = ["evaluate", bags["eight"], "--method", "zupt", "--json"]
    assert main([*evaluate, "--calibration", target]) == 0
    corrected = json.loads(capsys.readouterr().out)
    assert main(evaluate) == 0
    as_recorded = json.loads(capsys.readouterr().out)
    assert corrected["calibration"] == {"left": ["accelerometer"], "right": ["accelerometer"]}
    assert as_recorded["calibration"] == {}
    assert corrected["distance_m"] != as_recorded["distance_m"]


def test_a_gyro_tells_its_bias_and_what_it_could_not_see(six, tmp_path, capsys):
    noise = tmp_path / "noise.yaml"
    command = ["calibrate", "gyro", *six, "--parameters", str(noise), "-o"]
    assert main([*command, str(tmp_path / "gyro.yaml")]) == 0
    captured = capsys.readouterr()
    assert "gyro bias" in captured.out
    assert "too short for the bias instability" in captured.err
    parameters = yaml.safe_load(noise.read_text())["/**"]["ros__parameters"]["noise"]
    assert set(parameters) == {"gyro", "accelerometer"}
    assert (tmp_path / "gyro_allan.png").is_file()


def test_a_walk_becomes_a_parameter_file_that_evaluate_takes(bags, tmp_path, capsys):
    target = tmp_path / "gait.yaml"
    assert main(["calibrate", "spacing", bags["eight"], "-o", str(target)]) == 0
    printed = capsys.readouterr().out
    assert "kappa" in printed
    assert "nan" not in printed  # a figure of eight is nowhere straight for long enough
    assert "not observable, the walk is nowhere straight" in printed
    assert (tmp_path / "gait_passing.png").is_file()
    evaluate = ["evaluate", bags["eight"], "--config", str(target), "--json"]
    assert main([*evaluate, "--method", "idc"]) == 0
    used = json.loads(capsys.readouterr().out)["parameters"]
    assert 0.1 < used["idc.distance"] < 0.2


def test_a_straight_walk_says_that_it_cannot_tell_the_distance(bags, capsys):
    assert main(["calibrate", "spacing", bags["line"], "--json"]) == 0
    captured = capsys.readouterr()
    facts = json.loads(captured.out)
    assert (facts["seen"], facts["c0_m"], facts["step_width_m"]) == (False, None, None)
    assert facts["kappa"] == pytest.approx(0.5, abs=0.05)
    assert "is unobservable" in captured.err


def test_exchanged_feet_are_said_by_calibrate_info_and_evaluate(bags, capsys):
    assert main(["calibrate", "spacing", bags["exchanged"]]) == 2
    assert "the sensors are exchanged" in capsys.readouterr().err
    assert main(["info", bags["exchanged"]]) == 0
    assert "left and right seem to be exchanged" in capsys.readouterr().out
    assert main(["evaluate", bags["exchanged"], "--json"]) == 0
    notes = json.loads(capsys.readouterr().out)["notes"]
    assert any("exchanged" in note for note in notes)
    assert main(["info", bags["eight"]]) == 0
    assert "exchanged" not in capsys.readouterr().out


@pytest.fixture(scope="module")
def doubtful(tmp_path_factory):
    """Return walks as bags: a lap with iron on the sensors, an eight with them turned outwards."""
    folder = tmp_path_factory.mktemp("doubtful")
    lap, iron = WalkConfig(route="track", rate=60.0, standing=5.0), MagnetometerConfig(hard_iron=3)
    made = simulate(lap, seed=2, magnetometer=iron)
    write_bag(folder / "lap", Recording(made.left, made.right))
    eight = simulate(WalkConfig(route="figure_eight", rate=60.0), seed=1)
    write_bag(folder / "outwards", Recording(turned(eight.left, 0.3), turned(eight.right, -0.3)))
    return {name: str(folder / name) for name in ("lap", "outwards")}


def turned(series, yaw):
    """Return the samples of a sensor that was turned on its foot by ``yaw`` (rad)."""
    c, s = np.cos(yaw), np.sin(yaw)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    force, rate = series.specific_force @ rotation, series.angular_rate @ rotation
    return ImuSeries(series.stamp_ns, force, rate)


@pytest.mark.parametrize(
    ("walk", "parameters"),
    [
        ("lap", ["--set", "aids.magnetic_heading=true"]),
        ("lap", ["--config", "liu2023"]),
        ("outwards", ["--set", "heading.source=sensor"]),
    ],
    ids=["a field with iron", "too little noise", "headings of the sensors"],
)
def test_tracks_that_parameters_bend_are_no_exchanged_feet(doubtful, capsys, walk, parameters):
    assert main(["evaluate", doubtful[walk], *parameters, "--json"]) == 0
    assert "exchanged" not in str(json.loads(capsys.readouterr().out)["notes"])
    assert main(["calibrate", "spacing", doubtful[walk], *parameters]) == 0


@pytest.mark.parametrize(
    "parameters", [["--config", "liu2023"], ["--set", "heading.source=sensor"]], ids=lambda p: p[1]
)
def test_exchanged_feet_are_said_whatever_the_parameters(bags, capsys, parameters):
    assert main(["evaluate", bags["exchanged"], *parameters, "--json"]) == 0
    assert "seem to be exchanged" in str(json.loads(capsys.readouterr().out)["notes"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["accelerometer", "no_such.csv"], "there is no file 'no_such.csv'"),
        (["accelerometer", "SIX", "--gravity", "9"], "--gravity is 9; allowed is 9.7 to 9.9"),
        (["accelerometer", "SIX", "--axes", "+x+x+z"], "an axis occurs twice"),
        (["accelerometer", "SIX", "--model", "full"], "need at least 9 attitudes"),
        (["accelerometer", "ONE"], "1 different attitude is too few"),
        (["accelerometer", "ONE", "EIGHT"], "exports and bags are given together"),
        (["accelerometer", "EIGHT", "--axes=+y-x+z"], "--axes does not apply: "),
        (["gyro", "EIGHT", "--rate-unit", "deg/s"], "--rate-unit does not apply: "),
        (["gyro", "EIGHT", "--skip", "3"], "--skip does not apply: "),
        (["accelerometer", "EIGHT"], "different attitude"),
        (["gyro", "EIGHT", "--left-topic", "/a", "--right-topic", "/b"], "name one with"),
        (["spacing", "no_such_bag"], "no_such_bag"),
        (["spacing", "EIGHT", "--set", "zupt.std=-1"], "parameter 'zupt.std' is -1"),
    ],
)
def test_what_cannot_be_used_is_a_sentence_and_exit_code_2(
    six, bags, tmp_path, monkeypatch, capsys, arguments, sentence
):
    monkeypatch.chdir(tmp_path)
    names = {"SIX": six, "ONE": six[:1], "EIGHT": [bags["eight"]]}
    given = [each for word in arguments for each in names.get(word, [word])]
    assert main(["calibrate", *given]) == 2
    captured = capsys.readouterr()
    assert sentence in captured.err
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []


def test_no_other_file_is_overwritten(six, bags, tmp_path, capsys):
    mine = tmp_path / "mine.yaml"
    mine.write_text("mine: true\n")
    assert main(["calibrate", "accelerometer", *six, "-o", str(mine)]) == 2
    assert "unknown key 'mine'" in capsys.readouterr().err
    assert main(["calibrate", "spacing", bags["eight"], "-o", str(mine)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert mine.read_text() == "mine: true\n"


def test_without_its_figure_a_calibration_is_not_written(six, tmp_path, capsys, monkeypatch):
    def full(fits, path):
        path.write_text("half a fig")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("dualfoot_ros.calibration.plots.draw_allan", full)
    output = tmp_path / "out"
    output.mkdir()
    assert main(["calibrate", "gyro", six[0], "-o", str(output / "gyro.yaml")]) == 2
    assert "_allan.png': it cannot be written: No space left on device" in capsys.readouterr().err
    assert list(output.iterdir()) == []


def test_a_stuck_sensor_is_refused_for_what_it_spoils_and_a_warning_for_the_rest(tmp_path, capsys):
    series = resting(SIX[0], 10.0)
    series.specific_force[:, 1] = 0.25
    path = str(export(tmp_path / "Axu.csv", series))
    assert main(["calibrate", "accelerometer", path]) == 2
    sentence = "'Axu': specific force y stays at 0.25 m/s^2 in 100% of the standstill"
    assert sentence in capsys.readouterr().err
    assert main(["calibrate", "gyro", path]) == 0
    captured = capsys.readouterr()
    assert f"warning: {sentence}" in captured.err
    assert "gyro bias" in captured.out
    assert "noise.accelerometer" not in captured.out


def test_samples_that_are_not_finite_are_counted_beside_the_calibration(six, tmp_path, capsys):
    series = resting(SIX[0], 10.0, bias=BIAS)
    series.specific_force[100:103] = np.nan
    path = str(export(tmp_path / "Axu.csv", series))
    assert main(["calibrate", "accelerometer", path, *six[1:]]) == 0
    assert "warning: 'Axu': 3 of 600 samples are not finite" in capsys.readouterr().err


def test_a_calibration_is_added_to_a_file_only(six, tmp_path, capsys):
    assert main(["calibrate", "gyro", six[0], "-o", str(tmp_path)]) == 2
    assert f"'{tmp_path}' is there and is no ordinary file" in capsys.readouterr().err


def test_parameters_replace_a_file_only_when_told_to_and_nothing_but_a_file(six, tmp_path, capsys):
    mine, pipe, output = tmp_path / "mine.yaml", tmp_path / "pipe", tmp_path / "gyro.yaml"
    mine.write_text("mine: true\n")
    os.mkfifo(pipe)
    command = ["calibrate", "gyro", six[0], "--no-plots", "-o", str(output), "--parameters"]
    assert main([*command, str(mine)]) == 2
    assert f"'{mine}' exists already" in capsys.readouterr().err
    assert mine.read_text() == "mine: true\n"
    for given in ([], ["--overwrite"]):
        assert main([*command, str(pipe), *given]) == 2
        assert f"'{pipe}' is there and is no ordinary file" in capsys.readouterr().err
    assert pipe.is_fifo()
    assert main([*command, str(tmp_path / "x" / ".." / "gyro.yaml")]) == 2
    assert "-o and --parameters both name" in capsys.readouterr().err
    assert not output.exists()
    assert main([*command, str(mine), "--overwrite"]) == 0
    assert "ros__parameters" in mine.read_text()


def test_an_output_that_cannot_be_written_is_named_as_it_was_given(six, tmp_path, capsys):
    (tmp_path / "file").write_text("")
    target = str(tmp_path / "file" / "x")
    assert main(["calibrate", "gyro", six[0], "-o", target]) == 2
    reason = f"'{target}': it cannot be written: '{tmp_path / 'file'}' is no folder"
    assert reason in capsys.readouterr().err


@pytest.mark.parametrize("what", ["accelerometer", "gyro", "spacing"])
def test_every_kind_has_help_with_examples(what, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["calibrate", what, "--help"])
    assert stopped.value.code == 0
    assert f"dualfoot calibrate {what}" in capsys.readouterr().out


def test_without_a_kind_the_kinds_are_named(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["calibrate"])
    assert stopped.value.code == 2
    assert "WHAT" in capsys.readouterr().err


def test_the_command_as_a_process_gives_json_on_standard_output_only(dualfoot, six):
    done = dualfoot("calibrate", "accelerometer", *six, "--json")
    assert done.returncode == 0
    assert json.loads(done.stdout)["sensor"]["model"] == "scale"
    assert done.stderr == ""


def test_the_real_set_is_calibrated_as_a_user_would(dualfoot, dual_feet, tmp_path):
    paths = sorted((dual_feet / "calibration").glob("A*.csv"))
    done = dualfoot("calibrate", "accelerometer", *paths, "-o", tmp_path / "right.yaml")
    assert done.returncode == 0
    assert "RMS residual 0.0332 before" in done.stdout
    bias = Calibration.load(tmp_path / "right.yaml").sensors["sensor"].accelerometer.bias
    assert np.allclose(bias, [-0.0172, 0.0347, -0.0153], atol=5e-4)
