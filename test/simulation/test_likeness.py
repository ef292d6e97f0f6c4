"""How like real walks the simulated ones are: what ``benchmark/likeness.py`` prints."""

import re
import sys
from functools import cache
from pathlib import Path

import pytest

from benchmark import likeness

ROOT = Path(__file__).parents[2]
SIMULATED = cache(likeness.simulated)  # the same walks for all tests


@pytest.fixture
def printed(monkeypatch, capsys):
    """Run the program; return what it prints and what it says on stderr."""

    def run(folder):
        monkeypatch.setattr(likeness, "simulated", SIMULATED)
        monkeypatch.setattr(sys, "argv", ["likeness", str(folder)])
        likeness.main()
        return capsys.readouterr()

    return run


def test_the_documentation_shows_what_the_program_prints(dual_feet, printed):
    run = printed(dual_feet)
    page = ROOT / "docs" / "explanation" / "simulation.md"
    documented = page.read_text(encoding="utf-8").splitlines()
    for line in run.out.splitlines():
        name = line.split("|")[1]
        there = next(each for each in documented if each.startswith(f"|{name}|"))
        assert numbers(there) == pytest.approx(numbers(line), rel=0.05), name


def numbers(line):
    """Return the figures in a row of the table."""
    return [float(each) for each in re.findall(r"[0-9]+(?:\.[0-9]+)?", line)]


def test_without_the_data_set_the_program_shows_the_simulated_walks_and_says_what_it_misses(
    tmp_path, printed
):
    run = printed(tmp_path)
    assert run.out.startswith("| | simulated, 1.2 m/s | simulated, 1.6 m/s |\n|---|---|---|\n")
    coning = numbers(run.out.splitlines()[-1].split("|", 2)[2])
    assert coning[2:] == pytest.approx([17.0, 18.0], abs=2.0)  # on the track
    assert (
        f"the dual-feet data set (rectangle_ccw, running_track) is not in '{tmp_path}'" in run.err
    )
