import re
import signal
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from drivers import frames
from rclpy.task import Future

from dualfoot_ros.nodes import bringup, fusion
from dualfoot_ros.recording import list_topics, read_bag


def test_bringup_plays_a_bag_records_what_comes_of_it_and_ends(program, short_bag, tmp_path):
    """No queue is shorter than the bag, so nothing is lost however slow the machine is."""
    target = tmp_path / "result"
    running = program(
        "bringup", "--ros-args", "-p", f"bag:={short_bag}", "-p", f"record:={target}",
        "-p", "play.rate:=20.0", "-r", "__ns:=/me", "-p", "engine:=compiled",
        "-p", "input.depth:=10000", "-p", "input.latency:=0.0",
    )  # fmt: skip
    assert running.code() == 0, running.output
    topics = list_topics(target)
    played = len(read_bag(short_bag).left)
    assert topics["/me/left/imu/data_raw"].messages == played
    assert topics["/me/left/odometry"].messages > 0.5 * played
    assert topics["/me/odometry"].messages == topics["/me/left/odometry"].messages
    assert topics["/me/fusion/events"].messages > 10


def test_it_goes_on_while_samples_are_taken_though_nothing_is_given_yet():
    """On a busy machine the bag may be over long before the alignment."""
    looks, reports, played = [], [], Future()
    node = SimpleNamespace(create_timer=lambda _period, look, clock: looks.append(look))
    taken = iter([(1, 0), (300, 0), (500, 0), (500, 7), (500, 7)])
    done = bringup._when_over(
        [SimpleNamespace(done=played)], node, lambda: next(taken), lambda: reports.append(1)
    )
    (look,) = looks
    look()
    assert not done.done()  # still playing: nobody asks what is taken
    played.set_result(True)
    for _ in range(4):
        look()
        assert not done.done()
    assert not reports
    look()
    assert done.done() and done.exception() is None
    assert reports == [1]  # what was lost since the last report is said, too


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


def test_the_files_that_help_names_are_there():
    named = re.findall(
        r"--params-file (\S+)", f"{bringup.PROGRAM.examples} {fusion.PROGRAM.examples}"
    )
    root = Path(__file__).resolve().parents[2]
    assert named and all((root / name).exists() for name in named)


def test_an_existing_recording_is_not_overwritten(program_here, walk_bag, tmp_path):
    (tmp_path / "result").mkdir()
    (tmp_path / "result" / "mine.txt").write_text("mine")
    arguments = ["-p", f"bag:={walk_bag}", "-p", f"record:={tmp_path / 'result'}"]
    running = program_here("bringup", "--ros-args", *arguments)
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


@pytest.fixture
def with_sources(program, tmp_path):
    """Start bringup with the sources of the two feet."""

    def start(left, right="topic:///b", program=program):
        path = tmp_path / "sources.yaml"
        sections = [
            f"/**/{foot}/imu_adapter:\n  ros__parameters:\n    source: '{source}'\n"
            for foot, source in (("left", left), ("right", right))
        ]
        path.write_text("".join(sections))
        return program("bringup", "--ros-args", "--params-file", path, "-r", "__ns:=/me")

    return start


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("imu", "parameter 'source' is 'imu'; allowed is topic:///NAME"),
        ("topic:///left foot", "names no topic"),
        ("serial:///dev/x", "does not say what the device sends"),
        ("udp://:8000?format=magic", "format is 'magic'; allowed is one of mcu"),
        ("tcp://here?format=mcu", "the address is 'here'; allowed is HOST:PORT"),
        ("ble://foot", "the Bluetooth address is 'foot'"),
        ("file:///no.bin?format=mcu", "the file '/no.bin' does not exist"),
        ("file:///no/such.csv", "there is no file '/no/such.csv'"),
    ],
)
def test_a_bad_source_of_one_foot_ends_it_all_with_the_node_s_name(
    with_sources, program_here, source, said
):
    running = with_sources("topic:///a", source, program_here)
    assert running.code() == 2
    assert "bringup: error: /me/right/imu_adapter: " in running.output
    assert said in running.output and "Traceback" not in running.output
    assert "[ERROR]" not in running.output, "one sentence, not a log line besides"


def test_a_file_that_cannot_be_read_ends_it_too_though_that_comes_out_later(with_sources):
    unreadable = Path("/proc/self/mem")
    if not unreadable.exists():
        pytest.skip("there is no file here that can be opened and not be read")
    running = with_sources(f"file://{unreadable}?format=mcu")
    assert running.code() == 2
    assert "bringup: error: /me/left/imu_adapter: source 'file:///proc/" in running.output
    assert "Traceback" not in running.output


def test_a_device_that_is_not_there_yet_is_reported_and_waited_for(with_sources):
    sources = "serial:///dev/no_such_port?format=mcu", "tcp://127.0.0.1:1?format=mcu"
    running = with_sources(*sources)
    for foot, source in zip(("left", "right"), sources, strict=True):
        running.wait_for(
            f"[me.{foot}.imu_adapter]: source '{source}' is not available and is tried again"
        )
    running.send(signal.SIGINT)
    assert running.code() == 0


def test_it_ends_when_the_files_of_both_feet_are_over(with_sources, tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(frames.stream("mcu", 300))
    source = f"file://{path}?format=mcu&speed=5"
    running = with_sources(source, source)
    assert running.code() == 0
    assert running.output.count("played 300 samples, the file is over") == 2
