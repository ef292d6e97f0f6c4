import json
import signal

import pytest

from dualfoot_ros.nodes.demo.__main__ import main
from dualfoot_ros.recording import Recording, read_bag, write_bag


def test_the_demonstration_prints_one_table_and_the_paths_of_its_plots(
    program, short_bag, tmp_path
):
    running = program("demo", short_bag, "-o", tmp_path / "out", "--methods", "zupt", "idc")
    assert running.code() == 0, running.output
    for method in ("zupt", "idc"):
        assert f"{method}: " in running.output
    assert running.output.count("equal to the offline run to the bit") == 2
    assert "[WARN]" not in running.output
    assert "RMSE (m)" in running.output and "crossed" in running.output
    plots = sorted((tmp_path / "out").glob("*.png"))
    assert len(plots) >= 4
    assert all(str(path) in running.output for path in plots)
    metrics = json.loads((tmp_path / "out" / "metrics.json").read_text())
    assert set(metrics["runs"]) == {"zupt", "idc"}


def test_ctrl_c_ends_it_with_130_and_nothing_written(program, walk_bag, tmp_path):
    running = program("demo", walk_bag, "-o", tmp_path / "out", "--methods", "zupt")
    running.wait_for("through the nodes")
    running.send(signal.SIGINT)
    assert running.code() == 130
    assert "Traceback" not in running.output
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("module", ["numpy", "dualfoot_ros.core", "rclpy"])
def test_ctrl_c_in_the_first_moments_is_no_traceback(
    program, walk_bag, tmp_path, monkeypatch, module
):
    monkeypatch.setenv("PYTHONPROFILEIMPORTTIME", "1")  # says what has been imported
    running = program("demo", walk_bag, "-o", tmp_path / "out", "--methods", "zupt")
    running.wait_for(f" {module}\n")
    running.send(signal.SIGINT)
    assert running.code() in (130, -signal.SIGINT)  # a shell shows 130 for either
    assert "Traceback" not in running.output


@pytest.mark.parametrize(
    ("keep", "said"),
    [({"left"}, "no samples of the right foot"), ({"left", "right"}, "no truth of both feet")],
)
def test_a_bag_that_lacks_something_is_one_sentence(walk_bag, tmp_path, capsys, keep, said):
    whole = read_bag(walk_bag)
    parts = {foot: whole.imu(foot)[:100] for foot in keep}
    path = write_bag(tmp_path / "bag", Recording(**parts))
    assert main([str(path), "-o", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("demo: error: ") and said in error
    assert not (tmp_path / "out").exists()


def test_an_unknown_method_names_those_that_exist(walk_bag, tmp_path, capsys):
    assert main([str(walk_bag), "--methods", "magic"]) == 2
    assert "'method' is 'magic'; allowed is one of zupt" in capsys.readouterr().err


def test_a_missing_bag_is_named(capsys):
    assert main(["/no/such/bag"]) == 2
    assert "/no/such/bag" in capsys.readouterr().err
