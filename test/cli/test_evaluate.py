"""``dualfoot evaluate`` as a user meets it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from dualfoot_ros.cli.main import main
from dualfoot_ros.recording import Recording, Reference, write_bag
from dualfoot_ros.simulation import BarometerConfig, WalkConfig, simulate


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """Return the first half minute of a simulated walk on disk, with truth."""
    made = simulate(WalkConfig(route="straight", rate=60.0, standing=4.0), seed=4)
    path, feet = tmp_path_factory.mktemp("bags") / "walk", (made.left[:1800], made.right[:1800])
    write_bag(path, Recording(*feet, made.left_truth, made.right_truth))
    return str(path)


@pytest.fixture(scope="module")
def one_foot(tmp_path_factory):
    """Return a recording of the left foot only."""
    made = simulate(WalkConfig(route="standing"), seed=4)
    path = tmp_path_factory.mktemp("bags") / "left_only"
    write_bag(path, Recording(left=made.left))
    return str(path)


def test_the_table_names_bag_method_alignment_and_both_feet(bag, capsys):
    assert main(["evaluate", bag, "--method", "zupt"]) == 0
    out = capsys.readouterr().out
    for word in ("method zupt", "first_strides", "RMSE (m)", "end error (%", "common", "crossed"):
        assert word in out


def test_json_is_one_object_and_nothing_else_whatever_is_written_beside_it(bag, tmp_path, capsys):
    target = tmp_path / "report"
    assert main(["evaluate", bag, "--json", "-o", str(target), "--no-plots"]) == 0
    metrics = json.loads(capsys.readouterr().out)
    assert metrics["alignment"]["method"] == "first_strides"
    assert metrics["parameters"]["method"] == metrics["method"]
    names = {
        "metrics.json",
        "strides.csv",
        "person.tum",
        "person.csv",
        "left.tum",
        "right.tum",
        "left_truth.tum",
        "right_truth.tum",
    }
    assert {p.name for p in target.iterdir()} == names
    assert sorted(metrics["files"]) == sorted(str(p) for p in target.iterdir())


def test_exports_are_written_where_they_are_asked_for_and_need_a_folder(bag, tmp_path, capsys):
    target = tmp_path / "report"
    asked = ["--origin", "48.1,11.5,90", "--estimate-bag"]
    assert main(["evaluate", bag, "--no-plots", "-o", str(target), *asked]) == 0
    names = {p.name for p in target.iterdir()}
    assert {"person.geojson", "person.kml", "person.gpx", "estimate_bag"} <= names
    assert main(["evaluate", bag, "--no-plots", "-o", str(target), *asked]) == 2
    assert "--overwrite" in capsys.readouterr().err
    again = ["--overwrite", "--no-plots", "-o", str(target), *asked]
    assert main(["evaluate", bag, *again]) == 0
    assert main(["evaluate", bag, *asked]) == 2
    assert "-o DIR" in capsys.readouterr().err
    assert main(["evaluate", bag, "--scale", "0.1", "-o", str(tmp_path / "new")]) == 2
    assert "--floor-plan" in capsys.readouterr().err


def test_a_report_is_not_written_into_the_bag_it_is_about(bag, capsys):
    before = sorted(Path(bag).iterdir())
    assert main(["evaluate", bag, "-o", bag, "--overwrite"]) == 2
    assert "outside" in capsys.readouterr().err
    assert sorted(Path(bag).iterdir()) == before


def test_the_paths_of_the_plots_are_printed_and_exist(bag, tmp_path, capsys):
    assert main(["evaluate", bag, "--method", "zupt", "-o", str(tmp_path / "new" / "report")]) == 0
    printed = capsys.readouterr().out.split()
    for name in ("tracks.png", "feet_distance.png", "stances.png", "errors.png"):
        path = tmp_path / "new" / "report" / name
        assert path.is_file()
        assert str(path) in printed


def test_without_an_output_folder_nothing_is_written(bag, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["evaluate", bag, "--method", "zupt"]) == 0
    assert list(tmp_path.iterdir()) == []


def test_the_best_fit_over_the_walk_is_another_alignment_with_less_rmse(bag, capsys):
    rmse = {}
    for align in ("first_strides", "umeyama4"):
        assert main(["evaluate", bag, "--method", "zupt", "--json", "--align", align]) == 0
        metrics = json.loads(capsys.readouterr().out)
        assert metrics["alignment"]["method"] == align
        rmse[align] = metrics["truth"]["midpoint"]["rmse_m"]
    assert rmse["umeyama4"] < rmse["first_strides"]


def test_a_parameter_set_by_hand_is_the_one_that_ran(bag, capsys):
    assert main(["evaluate", bag, "--json", "--method", "zupt", "--set", "zupt.std=2e-2"]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["zupt.std"] == 0.02


def test_a_reference_from_elsewhere_is_used(bag, tmp_path, capsys):
    file = tmp_path / "markers.yaml"
    Reference("a test", {"right": [[0.0, 0.0, 0.0], [1.2, 0.0, 0.0]]}).save(file)
    assert main(["evaluate", bag, "--method", "zupt", "--json", "--reference", str(file)]) == 0
    metrics = json.loads(capsys.readouterr().out)
    assert metrics["markers"]["right"]["markers"] == 2
    assert "for 2 markers" in metrics["notes"][0]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--method", "magic"], "parameter 'method' is 'magic'; allowed is one of"),
        (["--set", "zupt.std=-1"], "parameter 'zupt.std' is -1"),
        (["--set", "zupt.std"], "allowed is KEY=VALUE"),
        (["--set", "zupt.sdt=1"], "unknown parameter 'zupt.sdt'"),
        (["--config", "no_such_preset"], "no_such_preset"),
        (["--align-length", "0"], "--align-length is 0"),
        (["--reference", "no_such_file.yaml"], "no_such_file.yaml"),
        (["--right-topic", "/imu"], "no samples of the right foot"),
    ],
)
def test_what_cannot_be_used_is_a_sentence_and_exit_code_2(bag, arguments, sentence, capsys):
    assert main(["evaluate", bag, *arguments]) == 2
    captured = capsys.readouterr()
    assert sentence in captured.err
    assert captured.out == ""


def test_a_foot_without_samples_has_dashes_and_half_a_truth_is_said(tmp_path, capsys):
    made = simulate(WalkConfig(route="straight", rate=60.0), seed=4)
    bag = str(write_bag(tmp_path / "w", Recording(made.left, left_truth=made.left_truth)))
    assert main(["evaluate", bag]) == 0
    out = capsys.readouterr().out
    rows = {cells[1].strip(): cells[3].strip() for cells in map(split_row, out.splitlines())}
    assert (rows["stances"], rows["distance walked (m)"], rows["steady strides"]) == (
        "-",
        "-",
        "-",
    )
    assert "no errors against the truth: they take both feet, here is the left one only" in out


def split_row(line):
    """Return the cells of a row of a table, and empty ones of another line."""
    cells = line.split("│")
    return cells if len(cells) > 4 else [""] * 5


def test_a_foot_that_is_asked_for_and_missing_leaves_no_folder(one_foot, tmp_path, capsys):
    out = str(tmp_path / "report")
    assert main(["evaluate", one_foot, "--feet", "right", "-o", out]) == 2
    assert "no samples of the right foot, which is asked for" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_output_that_is_a_file_is_refused_before_anything_is_read(tmp_path, capsys):
    file = tmp_path / "report"
    file.write_text("mine")
    assert main(["evaluate", "no_such_bag", "-o", str(file)]) == 2
    assert "is a file" in capsys.readouterr().err
    assert file.read_text() == "mine"


def test_the_command_as_a_process_gives_json_on_standard_output_only(bag):
    command = [sys.executable, "-m", "dualfoot_ros", "evaluate", bag, "--method", "zupt", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["method"] == "zupt"
    assert done.stderr == ""


def test_the_barometer_can_be_switched_on_and_its_height_error_is_in_the_table(tmp_path, capsys):
    climb = WalkConfig(route="stairs", rate=60.0)
    made = simulate(climb, seed=0, barometer=BarometerConfig(worn="body"))
    truth = made.left_truth, made.right_truth
    bag = str(
        write_bag(
            tmp_path / "climb", Recording(made.left, made.right, *truth, pressure=made.pressure)
        )
    )
    drifting = ["--set", "zupt.lever_back=0"]  # with the pivot below the sensor walks climb
    command = ["evaluate", bag, *drifting, "--method", "step_length", "--json"]
    figures = []
    for switch in ("false", "true"):
        assert main([*command, "--set", f"aids.barometer={switch}"]) == 0
        figures.append(json.loads(capsys.readouterr().out))
    off, on = (f["truth"]["midpoint"]["rmse_vertical_m"] for f in figures)
    assert on < 0.75 * off
    assert figures[1]["counters"]["pressures"] == figures[0]["counters"]["pressure_unused"] > 1000
    assert main([*command[:-1]]) == 0
    table = capsys.readouterr().out
    assert "height RMSE (m)" in table
    assert "with aids.barometer=true they give the height" in " ".join(table.split())


def test_the_magnetic_heading_without_a_field_in_the_bag_is_one_sentence_and_code_2(bag, capsys):
    assert main(["evaluate", bag, "--set", "aids.magnetic_heading=true"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("dualfoot evaluate: error: aids.magnetic_heading is on but")
    assert "/left/imu/mag" in said and len(said.splitlines()) == 1


def test_a_preset_says_what_makes_it_worse_and_takes_the_papers_numbers_when_asked(bag, capsys):
    found = []
    for arguments in ([], ["--config", "liu2023"], ["--config", "liu2023", "--paper-noise"]):
        assert main(["evaluate", bag, *arguments, "--json"]) == 0
        found.append(json.loads(capsys.readouterr().out))
    plain, preset, paper = found
    assert not any("as in the paper" in note for note in plain["notes"])
    assert any("zero velocity holds at the sensor" in note for note in preset["notes"])
    assert not any("constraint is hard" in note for note in preset["notes"])
    assert any("constraint is hard (idc.distance_std is 0)" in note for note in paper["notes"])
    gyro = [each["parameters"]["noise.gyro"] for each in found]
    assert gyro[0] == gyro[1] > gyro[2]


def test_the_noise_of_a_paper_without_a_preset_is_one_sentence_and_code_2(bag, capsys):
    assert main(["evaluate", bag, "--paper-noise"]) == 2
    assert "noise of a paper is asked for with no preset" in capsys.readouterr().err


def test_a_walk_can_calibrate_itself_and_the_report_says_so(tmp_path, capsys):
    made = simulate(WalkConfig(route="figure_eight", rate=60.0, standing=5.0), seed=1)
    feet = made.left[:3000], made.right[:3000]
    bag = str(write_bag(tmp_path / "eight", Recording(*feet)))
    assert main(["evaluate", bag, "--self-calibrate", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["self_calibrated"] is True
    assert found["calibration"] == {"left": ["gyro"], "right": ["gyro"]}
    assert any("gyro matrices from this walk itself" in note for note in found["notes"])
    assert any("left: the accelerometer is not calibrated" in note for note in found["notes"])
