"""`dualfoot info` as a user runs it: words, JSON, and the exit code for what cannot be used."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from dualfoot_ros.core import ImuSeries, Increments
from dualfoot_ros.recording import Recording, read_bag, write_bag

GRAVITY = 9.80665
DEMO = Path(__file__).resolve().parents[2] / "bags" / "demo"


def standing(seed, count=600, start_ns=10**18):
    rng = np.random.default_rng(seed)
    force = rng.normal(0.0, 0.01, (count, 3)) + np.array([0.0, 0.0, GRAVITY + 0.1])
    rate = rng.normal(0.0, 0.002, (count, 3)) + np.deg2rad([0.5, -1.0, 2.0])
    return ImuSeries(start_ns + np.arange(count) * 10_000_000, force, rate)


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    left, right = standing(1), standing(2, start_ns=10**18 + 4_000_000)
    right = right[np.r_[0:500, 520:600]]
    return write_bag(tmp_path_factory.mktemp("bags") / "walk", Recording(left, right))


def test_the_words_tell_what_is_in_the_bag(bag, dualfoot):
    done = dualfoot("info", bag)
    assert (done.returncode, done.stderr) == (0, "")
    for words in (
        "/left/imu/data_raw  sensor_msgs/msg/Imu, 600 messages",
        "100.00 Hz",
        "1 gaps",
        "stands still from 0.0 to 6.0 s",
        "gyro bias (+0.50",
        "so the accelerometer is off by +0.",
        "right foot starts 4.000 ms after the left",
        "truth: none",
        "warning: right foot: 1 gaps, the longest 0.210 s",
        "the bag can be evaluated",
    ):
        assert words in done.stdout


def test_the_words_tell_what_the_samples_are_or_that_nothing_says_it(
    bag, tmp_path, dualfoot, dualfoot_process
):
    unknown = dualfoot("info", bag, "--no-stances").stdout
    assert unknown.count("nothing says what the samples are: taken for averaged") == 2
    left = replace(standing(1), increments=Increments.COMPENSATED)
    known = write_bag(tmp_path / "known", Recording(left, standing(2)))
    words = dualfoot("info", known, "--no-stances").stdout
    assert "samples are compensated increments (compensated), as the recording says" in words
    assert "--set increments.right=compensated or sampled otherwise" in words
    feet = json.loads(dualfoot_process("info", known, "--json", "--no-stances").stdout)["feet"]
    assert [feet[foot]["increments"] for foot in ("left", "right")] == ["compensated", None]


def test_json_is_one_object_and_nothing_else(bag, dualfoot_process):
    done = dualfoot_process("info", bag, "--json")
    assert (done.returncode, done.stderr) == (0, "")
    facts = json.loads(done.stdout)
    assert facts["usable"] is True
    assert facts["topics"]["/right/imu/data_raw"]["messages"] == 580
    left = facts["feet"]["left"]
    assert left["rate_hz"] == pytest.approx(100.0)
    assert np.allclose(np.rad2deg(left["stand"]["angular_rate"]), [0.5, -1.0, 2.0], atol=0.03)
    assert left["stand"]["specific_force"][2] == pytest.approx(GRAVITY + 0.1, abs=0.01)
    assert [f["name"] for f in facts["findings"]] == ["gaps"]


def scaled(series, force=1.0):
    return ImuSeries(series.stamp_ns, series.specific_force * force, series.angular_rate)


@pytest.mark.parametrize(
    ("recording", "sentence"),
    [
        (Recording(scaled(standing(1), 1 / GRAVITY), standing(2)), "left foot.* in g and not"),
        (Recording(standing(1), standing(2, start_ns=0)), "do not overlap in time"),
    ],
)
def test_what_cannot_be_evaluated_is_told_and_ends_with_2(tmp_path, recording, sentence, dualfoot):
    bag = write_bag(tmp_path / "walk", recording)
    for arguments in ([], ["--json"]):
        done = dualfoot("info", bag, *arguments)
        assert done.returncode == 2
        assert done.stderr.startswith("dualfoot info: error: ")

        assert re.search(sentence, done.stderr)
    assert json.loads(done.stdout)["usable"] is False


def test_a_bag_of_one_foot_can_be_evaluated_and_says_which_is_missing(tmp_path, dualfoot):
    done = dualfoot("info", write_bag(tmp_path / "walk", Recording(standing(1))))
    assert done.returncode == 0
    assert "warning: there are no samples of the right foot" in done.stdout
    assert "so the left foot is tracked alone" in done.stdout


def test_a_walk_of_one_foot_is_not_measured_against_a_foot_that_is_not_there(tmp_path, dualfoot):
    left = read_bag(DEMO).left
    done = dualfoot("info", write_bag(tmp_path / "walk", Recording(left[: len(left) // 4])))
    assert done.returncode == 0
    assert "stances (median" in done.stdout
    assert done.stdout.count("warning:") == 1  # that the right foot is missing


def test_topics_of_other_names_are_offered_and_can_be_given(bag, dualfoot):
    done = dualfoot("info", bag, "--left-topic", "/imu")
    assert done.returncode == 2
    assert "'/imu'" in done.stderr
    assert "/left/imu/data_raw" in done.stderr


def test_a_real_walk_is_told_with_its_stances(tmp_path, dual_feet, dualfoot):
    source = dual_feet / "rectangle_ccw" / "XF_2Laces_ccw_1.mat"
    bag = tmp_path / "walk"
    dualfoot("import", source, "-o", bag)
    facts = json.loads(dualfoot("info", bag, "--json").stdout)
    assert facts["feet"]["right"]["stances"]["count"] == 21
    assert facts["feet"]["right"]["stances"]["distance_m"] == pytest.approx(24.0, rel=0.03)
    stand = facts["feet"]["left"]["stand"]
    assert stand["end_s"] - stand["start_s"] > 4.0
