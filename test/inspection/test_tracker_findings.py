"""What a tracker says of a walk itself, `info` and `evaluate` say alike."""

import json
from dataclasses import replace
from importlib import import_module

import pytest

from dualfoot_ros.core import Event, EventKind
from dualfoot_ros.evaluation import run
from dualfoot_ros.inspection import FindingKind, lost_foot_findings
from dualfoot_ros.recording import Recording, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """Return a bag of somebody who hardly stands before walking."""
    walk = {"route": "straight", "rate": 60.0, "standing": 1.5, "final_standing": 2.0}
    made = simulate(WalkConfig.from_mapping(walk), seed=3)
    path = tmp_path_factory.mktemp("bags") / "walk"
    return write_bag(path, Recording(made.left, made.right, made.left_truth, made.right_truth))


@pytest.fixture
def warnings(bag, dualfoot):
    """Return the warnings that a verb gives of the bag, as sentences."""

    def found(verb: str, *options: str) -> list[str]:
        done = dualfoot(verb, bag, "--json", *options)
        assert done.returncode == 0, done.stderr
        facts = json.loads(done.stdout)
        if verb == "info":
            return [each["sentence"] for each in facts["findings"]]
        return [note.removeprefix("warning: ") for note in facts["notes"]]

    return found


def test_both_verbs_give_one_verdict(warnings):
    said = warnings("info")
    assert any("heading may be off by" in sentence for sentence in said)
    assert said == warnings("evaluate")


@pytest.mark.parametrize(
    "arguments",
    [["info"], ["evaluate"], ["evaluate", "--method", "zupt"], ["evaluate", "--feet", "right"]],
    ids=" ".join,
)
def test_a_heading_that_is_lost_at_the_end_is_said(warnings, arguments, monkeypatch):
    """The same that `fusion` says."""
    assert not any("heading is lost" in sentence for sentence in warnings(*arguments))
    module = import_module("dualfoot_ros.inspection.findings.tracker_findings")
    monkeypatch.setattr(module, "LOST_HEADING_STD", 0.001)
    assert sum("heading is lost" in sentence for sentence in warnings(*arguments)) == 1


def test_a_foot_that_was_lost_is_said_once_a_foot_with_its_first_moment():
    aligned = Event(EventKind.ALIGNED, 10**10, "both", 10**10)
    lost = [Event(EventKind.LOST, 10**10 + k * 10**9, "left", 10**11) for k in (3, 5)]
    assert list(lost_foot_findings([aligned])) == []
    (found,) = lost_foot_findings([aligned, *lost])
    assert (found.kind, found.about) == (FindingKind.LOST_FOOT, "left")
    assert "first 3.0 s after the start of the track, 2 times in all" in found.sentence
    (now,) = lost_foot_findings(lost[:1])
    assert "after the start" not in now.sentence


def test_spikes_that_no_other_finding_names_are_said_as_a_foot_that_was_lost():
    made = simulate(WalkConfig.from_mapping({"route": "straight", "rate": 60.0}), seed=3)
    force = made.left.specific_force.copy()
    middle = len(force) // 2
    force[middle : middle + 60 : 6, 0] += 100.0
    spiked = replace(made.left, specific_force=force)
    kinds = {each.kind for each in run(Recording(spiked, made.right)).findings}
    assert FindingKind.LOST_FOOT in kinds
