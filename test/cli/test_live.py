"""``dualfoot live``: the node with its arguments, or one sentence."""

import signal
import sys

import pytest

from dualfoot_ros.cli import live


@pytest.fixture
def started(monkeypatch):
    """Catch the command that the verb becomes."""
    found = []
    monkeypatch.setattr(live, "find_spec", lambda name: object())
    monkeypatch.setattr(live.os, "execv", lambda path, command: found.extend(command))
    return found


def test_the_verb_becomes_the_node_with_the_same_settings(started, dualfoot):
    dualfoot("live", "--port", "9000", "--open", "--namespace", "anna/")
    assert started[:3] == [sys.executable, "-m", "dualfoot_ros.nodes.page"]
    said = " ".join(started[3:])
    assert said == ("--ros-args -p host:=127.0.0.1 -p port:=9000 -p open:=true -r __ns:=/anna")


def test_without_a_namespace_none_is_given(started, dualfoot):
    dualfoot("live")
    assert "port:=8770" in started and "open:=false" in started
    assert not any("__ns" in word for word in started)


def test_without_ros_a_sentence_says_what_to_install(monkeypatch, dualfoot):
    monkeypatch.setattr(live, "find_spec", lambda name: None)
    done = dualfoot("live")
    assert done.returncode == 2
    assert "needs ROS 2" in done.stderr and "extra 'ros'" in done.stderr


def test_ctrl_c_ends_the_page_with_code_0_and_without_a_traceback(session):
    pytest.importorskip("rclpy")
    running = session("-m", "dualfoot_ros", "live", "--port", "0")
    assert running.until(
        lambda each: "the page is at http://127.0.0.1:" in each.said(), "the page"
    )
    running.send(signal.SIGINT)
    ended = running.end()
    assert ended.code == 0
    assert "Traceback" not in ended.out + ended.error


def test_ctrl_c_while_ros_is_being_imported_is_no_traceback_either(session):
    pytest.importorskip("rclpy")
    running = session("-m", "dualfoot_ros", "live", "--port", "0")
    assert running.until(lambda each: each.maps(each.pid, "_rclpy_pybind11"), "the import")
    running.send(signal.SIGINT)
    ended = running.end()
    assert ended.code == 0
    assert "Traceback" not in ended.out + ended.error
