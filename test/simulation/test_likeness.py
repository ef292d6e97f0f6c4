"""How like real walks the simulated ones are: what ``benchmark/likeness.py`` prints."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def likeness(*arguments, **options):
    """Run the program."""
    command = [sys.executable, ROOT / "benchmark" / "likeness.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def test_the_documentation_shows_what_the_program_prints(dual_feet):
    run = likeness(dual_feet)
    assert run.returncode == 0, run.stderr
    page = ROOT / "docs" / "explanation" / "simulation.md"
    documented = page.read_text(encoding="utf-8").splitlines()
    for line in run.stdout.splitlines():
        name = line.split("|")[1]
        there = next(each for each in documented if each.startswith(f"|{name}|"))
        assert numbers(there) == pytest.approx(numbers(line), rel=0.05), name


def numbers(line):
    """Return the figures in a row of the table."""
    return [float(each) for each in re.findall(r"[0-9]+(?:\.[0-9]+)?", line)]


def test_without_the_data_set_the_program_shows_the_simulated_walks_and_says_what_it_misses(
    tmp_path,
):
    run = likeness(tmp_path)
    assert run.returncode == 0
    assert run.stdout.startswith("| | simulated, 1.2 m/s | simulated, 1.6 m/s |\n|---|---|---|\n")
    coning = numbers(run.stdout.splitlines()[-1].split("|", 2)[2])
    assert coning[2:] == pytest.approx([17.0, 18.0], abs=2.0)  # on the track
    assert (
        f"the dual-feet data set (rectangle_ccw, running_track) is not in '{tmp_path}'"
        in run.stderr
    )
