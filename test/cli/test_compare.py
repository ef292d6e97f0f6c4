"""``dualfoot compare`` as a user meets it."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.calibration import Calibration, SensorCalibration, Triad
from dualfoot_ros.cli.main import main
from dualfoot_ros.recording import Recording, read_bag, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    """Return the folders of the first half minutes of two simulated walks, with truth."""
    folder = tmp_path_factory.mktemp("bags")
    for seed in (4, 5):
        made = simulate(WalkConfig(route="straight", rate=60.0, standing=4.0), seed=seed)
        feet = made.left[:1800], made.right[:1800]
        recording = Recording(*feet, made.left_truth, made.right_truth)
        write_bag(folder / f"walk{seed}", recording)
    return [str(folder / "walk4"), str(folder / "walk5")]


def test_one_table_has_a_line_for_every_method_but_the_one_for_one_shoe(bags, capsys):
    assert main(["compare", bags[0], "--jobs", "1"]) == 0
    out = capsys.readouterr().out
    for name in ("zupt", "mdmd_ckf", "spacing_vector", "varying_distance", "step_length"):
        assert name in out
    assert "rigid_pair" not in out


def test_the_json_has_every_run_of_every_bag_the_same_in_one_process_and_in_two(bags, capsys):
    found = []
    for jobs in ("1", "2"):
        arguments = ["compare", *bags, "--methods", "zupt,idc", "--json", "--jobs", jobs]
        assert main(arguments) == 0
        found.append(json.loads(capsys.readouterr().out))
    assert [(run["bag"], run["case"]) for run in found[0]["runs"]] == [
        (bag, name) for bag in bags for name in ("zupt", "idc")
    ]
    for document in found:
        assert document["failed"] == {}
        for run in document["runs"]:
            assert run.pop("run_s") > 0.0
    assert found[0] == found[1]


def test_a_bag_that_fails_is_named_and_the_others_go_on(bags, tmp_path, capsys):
    missing = str(tmp_path / "nowhere")
    code = main(["compare", missing, bags[0], "--methods", "zupt,idc", "--csv", "--jobs", "1"])
    assert code == 1
    out, err = capsys.readouterr()
    assert {row["case"] for row in csv.DictReader(out.splitlines())} == {"zupt", "idc"}
    assert err.count("nowhere") >= 1 and len(err.strip().splitlines()) == 1


def test_when_nothing_can_be_compared_the_code_says_so(tmp_path, capsys):
    assert main(["compare", str(tmp_path / "nowhere"), "--methods", "zupt"]) == 2
    assert "nowhere" in capsys.readouterr().err


def test_the_report_has_figures_of_tracks_and_sweeps(bags, tmp_path, capsys):
    target = tmp_path / "report"
    arguments = ["--methods", "zupt,idc", "--sweep", "kappa=0.5,0.6", "-o", str(target)]
    assert main(["compare", bags[0], *arguments, "--jobs", "1"]) == 0
    names = {"compare.json", "compare.csv", "tracks_walk4.png", "sweep_kappa.png", "report.html"}
    assert {path.name for path in target.iterdir()} == names
    assert all(path.stat().st_size > 500 for path in target.iterdir())
    printed = capsys.readouterr().out
    assert all(str(target / name) in printed for name in names)
    rows = list(csv.DictReader((target / "compare.csv").open()))
    assert [row["value"] for row in rows] == ["", "", "0.5", "0.6"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--methods", "ukf"], "'ukf' is no method"),
        (["--sweep", "kappa=1"], "has the parameter"),
        (["--sweep", "kappa"], "--sweep 'kappa'"),
        (["--repeat", "0"], "--repeat is 0; allowed is 1 to 20"),
        (["--jobs", "0"], "--jobs is 0; allowed"),
        (["--set", "zupt.std=9"], "zupt.std"),
        (["--config", "nothing"], "unknown preset 'nothing'"),
    ],
)
def test_arguments_that_cannot_be_used_are_refused_before_anything_runs(
    arguments, said, tmp_path, capsys
):
    given = ["--methods", "zupt"] if "--methods" not in arguments else []
    assert main(["compare", str(tmp_path), *given, *arguments]) == 2
    assert said in capsys.readouterr().err


def test_a_walk_repeated_four_times_is_four_times_as_long(bags, capsys):
    found = []
    for times in ("1", "4"):
        arguments = ["--methods", "zupt", "--repeat", times, "--json", "--jobs", "1"]
        assert main(["compare", bags[0], *arguments]) == 0
        (run,) = json.loads(capsys.readouterr().out)["runs"]
        found.append(run)
    assert found[1]["distance_m"]["right"] > 3.5 * found[0]["distance_m"]["right"]
    assert found[1]["truth"] is None


@pytest.mark.parametrize("aid", ["barometer", "magnetic_heading"])
def test_a_repeated_walk_has_no_pressure_and_no_field_for_an_aid(bags, capsys, aid):
    arguments = ["--methods", "zupt", "--repeat", "2", "--set", f"aids.{aid}=true", "--jobs", "1"]
    assert main(["compare", bags[0], *arguments]) == 2
    assert f"aids.{aid} is on with --repeat 2; " in capsys.readouterr().err


def test_presets_in_a_table_are_explained_below_it(bags, capsys):
    assert main(["compare", bags[0], "--methods", "zupt,liu2023", "--jobs", "1"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "liu2023: the zero velocity holds at the sensor" in said
    assert "zupt: the zero velocity" not in said


def test_what_is_wrong_with_a_bag_is_said_once_below_the_tables(bags, tmp_path, capsys):
    good = read_bag(bags[0])
    left = replace(good.left, angular_rate=-good.left.angular_rate)
    bad = str(write_bag(tmp_path / "negated", replace(good, left=left)))
    command = ["compare", bags[0], bad, "--methods", "zupt,idc", "--jobs", "1"]
    assert main([*command, "-o", str(tmp_path / "report")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("warning: left foot: the angular rate has the wrong sign") == 1
    assert "negated: warning: left foot" in said.replace("- ", "-")
    assert f"{bags[0]}: warning" not in said
    page = (tmp_path / "report" / "report.html").read_text()
    assert page.count("negated: left foot: the angular rate has the wrong sign") == 1


def test_a_calibration_corrects_every_bag(bags, tmp_path, capsys):
    triad = Triad(np.zeros(3), 1.02 * np.eye(3))
    sensors = {foot: SensorCalibration(gyro=triad) for foot in ("left", "right")}
    path = tmp_path / "both.yaml"
    Calibration(sensors).save(path)
    ends = []
    for arguments in ([], ["--calibration", str(path)]):
        command = ["compare", bags[0], "--methods", "zupt", "--json", "--jobs", "1"]
        assert main([*command, *arguments]) == 0
        ends.append(json.loads(capsys.readouterr().out)["runs"][0]["closure"]["left_m"])
    assert ends[0] != ends[1]
