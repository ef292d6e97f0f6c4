"""`dualfoot import` of bags as drivers leave them: stamps of arrival, bursts, zeros, ROS 1."""

import json
import re

import numpy as np
import pytest
from drivers.frames import stream
from recording.foreign import cut, ros1_bag, ros2_bag
from recording.samples import moving

from dualfoot_ros.recording import Recording, read_bag
from dualfoot_ros.simulation import WalkConfig, simulate

OTHER = ("/imu_left/data", "/imu_right/data")


@pytest.fixture(scope="module")
def walk():
    """Return the first 40 s of a simulated walk at 60 Hz."""
    made = simulate(WalkConfig(rate=60.0, standing=5.0), seed=4)
    return Recording(made.left[:2400], made.right[:2400])


def topics_of(recording, names=("/left/imu/data_raw", "/right/imu/data_raw")):
    return dict(zip(names, (recording.left, recording.right), strict=True))


def distances(bag, dualfoot):
    done = dualfoot("info", bag, "--json")
    feet = json.loads(done.stdout)["feet"]
    return [feet[foot]["stances"]["distance_m"] for foot in ("left", "right")]


@pytest.fixture(scope="module")
def whole(tmp_path_factory, walk, dualfoot):
    """Return how far the feet walked by the true stamps."""
    return distances(ros2_bag(tmp_path_factory.mktemp("true") / "walk", topics_of(walk)), dualfoot)


def late(walk, delays):
    return {"stamps": walk.left.stamp_ns + delays, "logged": walk.left.stamp_ns + 10_000_000}


def jitter(walk):
    count = len(walk.left)
    return np.random.default_rng(0).exponential(6e6, count).astype(np.int64)


def bursts(walk):
    stamps = walk.left.stamp_ns
    last = np.minimum((np.arange(len(stamps)) // 4 + 1) * 4 - 1, len(stamps) - 1)
    return stamps[last] - stamps


@pytest.mark.parametrize(
    ("delays", "advice", "usable"),
    [(jitter, "stamps jitter by", True), (bursts, "have the stamp of the one before", False)],
)
def test_stamps_of_arrival_are_warned_of_and_evened_out_as_the_warning_says(
    tmp_path, walk, whole, delays, advice, usable, dualfoot
):
    bag = ros2_bag(tmp_path / "walk", topics_of(walk), **late(walk, delays(walk)))
    done = dualfoot("info", bag)
    said = done.stdout + done.stderr
    assert advice in said
    assert "'dualfoot import BAG --stamps index -o NEW'" in said
    assert (done.returncode == 0) is usable
    evaluated = dualfoot("evaluate", bag, "--method", "zupt")
    assert (evaluated.returncode == 0) is usable
    assert advice in evaluated.stdout + evaluated.stderr
    done = dualfoot("import", bag, "--stamps", "index", "-o", "even", cwd=tmp_path)
    assert done.returncode == 0
    assert "(0 samples missing)" in done.stdout
    found = read_bag(tmp_path / "even")
    off = (found.left.stamp_ns - walk.left.stamp_ns) * 1e-6
    assert np.abs(off - np.median(off)).max() < 1.5  # ms
    assert np.abs(found.left.stamp_ns - found.right.stamp_ns).max() < 1_000_000
    assert distances(tmp_path / "even", dualfoot) == pytest.approx(whole, rel=0.01)


def test_headers_of_zero_are_replaced_by_the_log_times(tmp_path, walk, whole, dualfoot):
    logged = walk.left.stamp_ns + jitter(walk) // 3
    zeros = np.zeros(len(logged), dtype=np.int64)
    bag = ros2_bag(tmp_path / "walk", topics_of(walk), stamps=zeros, logged=logged)
    done = dualfoot("info", bag)
    assert done.returncode == 2
    assert "'dualfoot import BAG --stamps log -o NEW'" in done.stderr
    for stamps in ("header", "index"):
        done = dualfoot("import", bag, "--stamps", stamps, "-o", "x", cwd=tmp_path)
        assert done.returncode == 2
        assert "with --stamps log" in done.stderr
        assert not (tmp_path / "x").exists()
    done = dualfoot("import", bag, "--stamps", "log", "-o", "even", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "stamps: log times, evened out: left every 16.66" in done.stdout
    assert distances(tmp_path / "even", dualfoot) == pytest.approx(whole, rel=0.01)


def test_a_bag_of_ros_1_with_other_topics_is_found_by_their_names(tmp_path, walk, whole, dualfoot):
    bag = ros1_bag(tmp_path / "walk.bag", topics_of(walk, OTHER))
    done = dualfoot("import", bag, "-o", "walk", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "taking /imu_left/data as left because its name says left" in done.stdout
    assert distances(tmp_path / "walk", dualfoot) == pytest.approx(whole, rel=1e-9)
    done = dualfoot("info", bag)
    assert done.returncode == 0
    assert "note: taking /imu_right/data as right because its name says right" in done.stderr


def test_a_bag_that_was_cut_off_is_described_as_far_as_it_goes(tmp_path, walk, dualfoot):
    bag = cut(ros2_bag(tmp_path / "walk", topics_of(walk)), 0.7)
    done = dualfoot("info", bag)
    assert done.returncode == 0
    assert "warning: the recording is not whole: 'walk.mcap' was cut off" in done.stdout
    assert "reindex" not in done.stdout + done.stderr
    assert "cut off" in dualfoot("evaluate", bag, "--method", "zupt").stdout
    counts = [int(n) for n in re.findall(r"data_raw .*?(\d+) messages", done.stdout)]
    assert counts == pytest.approx([0.7 * len(walk.left)] * 2, rel=0.02)


def test_several_topics_of_a_foot_are_asked_for_by_name(tmp_path, dualfoot):
    series = moving(1, count=300)
    names = ("/left/imu", "/left/imu_filtered", "/right/imu")
    bag = ros2_bag(tmp_path / "walk", dict.fromkeys(names, series))
    for verb in (["info"], ["evaluate"], ["import", "-o", tmp_path / "new"]):
        done = dualfoot(*verb, bag)
        assert done.returncode == 2
        assert "name one with --left-topic, /left/imu or /left/imu_filtered" in done.stderr


CSV_OPTIONS = [
    (
        ["--capture-rate", "100"],
        "--capture-rate does not apply to the format xsens-dot; it is for capture",
    ),
    (["--stamps", "log"], "--stamps does not apply to the format xsens-dot"),
    (["--left-topic", "/a"], "--left-topic does not apply"),
]


@pytest.mark.parametrize(("option", "sentence"), CSV_OPTIONS)
def test_an_option_that_does_not_apply_to_the_format_is_refused(
    tmp_path, option, sentence, dualfoot
):
    for name in ("L.csv", "R.csv"):
        (tmp_path / name).write_text("PacketCounter,SampleTimeFine\n")
    files = ["--left", "L.csv", "--right", "R.csv", "--format", "xsens-dot"]
    done = dualfoot("import", *files, *option, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert sentence in done.stderr


def test_an_option_of_exports_is_refused_for_a_bag(tmp_path, dualfoot):
    bag = ros2_bag(tmp_path / "walk", {"/left/imu/data_raw": moving(1, count=300)})
    done = dualfoot("import", bag, "--field-scale", "1e-5", "-o", "new", cwd=tmp_path)
    assert done.returncode == 2
    assert "--field-scale does not apply to the format rosbag" in done.stderr


def test_a_layout_of_a_table_is_refused_for_a_bag(tmp_path, dualfoot):
    (tmp_path / "walk.mcap").write_bytes(b"")
    (tmp_path / "mine.yaml").write_text("format: dualfoot_layout\n")
    for option in (["--rate", "100"], ["--layout", "mine.yaml"]):
        done = dualfoot("import", "walk.mcap", *option, "-o", "walk", cwd=tmp_path)
        assert done.returncode == 2
        refusal = f"{option[0]} does not apply to the format rosbag; it is for csv"
        assert refusal in done.stderr


def test_one_topic_for_both_feet_is_refused(tmp_path, walk, dualfoot):
    bag = ros2_bag(tmp_path / "walk", topics_of(walk))
    one = "/left/imu/data_raw"
    done = dualfoot("import", bag, "--left-topic", one, "--right-topic", one, "-o", "x")
    assert done.returncode == 2
    assert "both feet hold the same samples" in done.stderr


def test_captured_bytes_are_described_in_place_of_a_bag(tmp_path, dualfoot):
    for first, foot in enumerate(("L", "R")):
        (tmp_path / f"{foot}.bin").write_bytes(stream("xbus", 400, first=first))
    files = ("--left", "L.bin", "--right", "R.bin")
    done = dualfoot("info", *files, cwd=tmp_path)
    assert "'*.bin' are of no known format" in done.stderr
    assert "name another with --capture" in done.stderr
    done = dualfoot("info", *files, "--capture", "xbus", "--json", cwd=tmp_path)
    assert json.loads(done.stdout)["feet"]["left"]["samples"] == 400
