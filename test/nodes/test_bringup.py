import signal

import numpy as np

from dualfoot_ros.recording import list_topics, read_bag


def test_bringup_plays_a_bag_records_what_comes_of_it_and_ends(program, walk_bag, tmp_path):
    target = tmp_path / "result"
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={walk_bag}", "-p", f"record:={target}",
        "-p", "play.rate:=4.0", "-r", "__ns:=/me", "-p", "engine:=compiled",
    )  # fmt: skip
    assert running.code() == 0, running.output
    topics = list_topics(target)
    played = len(read_bag(walk_bag).left)
    assert topics["/me/left/imu/data_raw"].messages > 0.5 * played
    assert topics["/me/left/odometry"].messages > 0.5 * played
    assert topics["/me/odometry"].messages == topics["/me/left/odometry"].messages
    assert topics["/me/fusion/events"].messages > 10


def test_a_recording_that_is_interrupted_is_a_whole_bag(program, walk_bag, tmp_path):
    target = tmp_path / "result"
    running = program("bringup", "--ros-args", "-p", f"bag:={walk_bag}", "-p", f"record:={target}")
    running.wait_for("aligned of both")
    running.send(signal.SIGINT)
    assert running.code() == 0
    assert "Traceback" not in running.output
    left = read_bag(target).left
    assert left is not None and len(left) > 50
    assert np.isfinite(left.specific_force).all()


def test_an_existing_recording_is_not_overwritten(program, walk_bag, tmp_path):
    (tmp_path / "result").mkdir()
    (tmp_path / "result" / "mine.txt").write_text("mine")
    arguments = ["-p", f"bag:={walk_bag}", "-p", f"record:={tmp_path / 'result'}"]
    running = program("bringup", "--ros-args", *arguments)
    assert running.code() == 2
    assert str(tmp_path / "result") in running.output
    assert (tmp_path / "result" / "mine.txt").read_text() == "mine"


def test_adapters_have_their_own_sections_in_one_file(program, tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(
        "/**/left/imu_adapter:\n  ros__parameters:\n    source: topic:///a\n"
        "/**/right/imu_adapter:\n  ros__parameters:\n    source: topic:///b\n"
        "/**/fusion:\n  ros__parameters:\n    frames.odom: map\n"
        "/**:\n  ros__parameters:\n    input.silence: 0.5\n"
    )
    running = program("bringup", "--ros-args", "--params-file", path, "-r", "__ns:=/me")
    running.wait_for("topic '/a' has no publisher")
    running.wait_for("topic '/b' has no publisher")
    assert "frames.odom=map" in running.output and "sync=external" in running.output
