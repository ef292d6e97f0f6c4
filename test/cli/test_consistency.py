"""``dualfoot consistency`` as a user meets it."""

import json

import pytest

from dualfoot_ros.cli.main import main
from dualfoot_ros.core import AlignmentError

FEW = ["--walks", "2", "--route", "straight", "--rate", "60", "--jobs", "1"]


def test_the_table_has_every_quantity_with_its_band_and_the_report_has_figures_and_plot(
    tmp_path, capsys
):
    target = tmp_path / "report"
    assert main(["consistency", *FEW, "--method", "idc", "-o", str(target)]) == 0
    out = capsys.readouterr().out
    assert {p.name for p in target.iterdir()} == {"consistency.json", "consistency.png"}
    assert json.loads((target / "consistency.json").read_text())["failed"] == {}
    assert str(target / "consistency.png") in out
    for words in ("idc: 2 walks", "left height", "relative position", "NEES", "NIS", "constraint"):
        assert words in out


def test_the_json_is_the_same_for_the_same_seeds_in_one_process_and_in_two(capsys):
    found = []
    for jobs in ("1", "2"):
        assert main(["consistency", *FEW[:-1], jobs, "--json", "--seed", "7"]) == 0
        found.append(json.loads(capsys.readouterr().out))
    assert found[0] == found[1]
    assert found[0]["walks"]["seeds"] == [7, 8]
    names = [score["name"] for score in found[0]["scores"]]
    assert "relative horizontal" in names and "zero velocity" in names
    assert all(score["band"][0] < 1.0 < score["band"][1] for score in found[0]["scores"])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--walks", "0"], "--walks is 0; allowed is 1 to 10000"),
        (["--seed", "-1"], "--seed is -1"),
        (["--route", "moon"], "moon"),
        (["--grade", "gold"], "grade is 'gold'"),
        (["--method", "ukf"], "ukf"),
        (["--rate", "10"], "rate"),
    ],
)
def test_what_cannot_be_simulated_is_refused(arguments, said, capsys):
    assert main(["consistency", *arguments]) == 2
    assert said in capsys.readouterr().err


def test_walks_that_cannot_be_tracked_are_named_by_their_seed(capsys, monkeypatch):
    def refused(job):
        raise AlignmentError("nobody stands")

    monkeypatch.setattr("dualfoot_ros.evaluation.batch.score_walk", refused)
    assert main(["consistency", *FEW]) == 2
    err = capsys.readouterr().err
    assert "walk of seed 0" in err and "walk of seed 1" in err
