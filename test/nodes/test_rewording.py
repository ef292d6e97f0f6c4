"""A sentence is for people: whatever it says, levels, kinds, counts and logging stay the same."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from inspection.kinds import kinds_made_in

from .rewording import reword

TESTS = Path(__file__).resolve().parents[1]


def run(*arguments):
    """Bring about every finding in a process of its own; return what it printed."""
    command = [sys.executable, str(TESTS / "nodes" / "findings_run.py"), *arguments]
    paths = [str(TESTS.parent), str(TESTS), *filter(None, [os.environ.get("PYTHONPATH")])]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    done = subprocess.run(
        command, env=env, check=False, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def plain():
    return run()


def test_rewording_every_sentence_changes_no_behaviour(plain):
    reworded = run("reword")
    assert reworded["outcome"] == plain["outcome"]
    assert len(reworded["texts"]) == len(plain["texts"]) > 100
    assert not set(reworded["texts"]) & set(plain["texts"])


def test_the_run_brings_about_every_kind_of_finding(plain):
    findings = (finding for findings, *_ in plain["outcome"] for finding in findings)
    assert {kind for kind, *_ in findings} == kinds_made_in("nodes")


def test_what_is_reworded_keeps_the_places_of_its_figures():
    assert reword("off by {skew:.0f} ppm") == "bss ol {skew:.0f} ccz"
