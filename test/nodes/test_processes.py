"""The executables as a user meets them: real processes, real signals."""

import signal
from pathlib import Path

import pytest

from dualfoot_ros.nodes.fusion import FusionNode

ROOT = Path(__file__).resolve().parents[2]
SIGNALS = {
    "fusion": [signal.SIGINT, signal.SIGTERM],
    "time_sync": [signal.SIGTERM],
    "imu_adapter": [signal.SIGINT],
    "bringup": [signal.SIGTERM],
    "replay": [signal.SIGINT],
    "live_page": [signal.SIGTERM],
}
"""Both of the node that is started most; all of them begin and end by the same code."""


def arguments(node, bag):
    own = {"replay": f"bag:={bag}", "live_page": "port:=0"}
    return ["--ros-args", "-p", own[node]] if node in own else []


@pytest.mark.parametrize(
    ("node", "number"), [(node, number) for node, numbers in SIGNALS.items() for number in numbers]
)
def test_a_signal_ends_a_node_with_code_0_and_without_traceback(program, node, number, walk_bag):
    running = program(node, *arguments(node, walk_bag))
    running.wait_for("configuration:")
    running.send(number)
    assert running.code() == 0
    assert "Traceback" not in running.output


ENTRY = """
import sys
from dualfoot_ros.nodes.entry import {node}
print("on", flush=True)
sys.exit({node}())
"""


@pytest.mark.parametrize(
    ("node", "number", "cpu_s"),
    [
        ("fusion", signal.SIGINT, 0.0),
        ("time_sync", signal.SIGTERM, 0.1),
        ("bringup", signal.SIGTERM, 0.3),
        ("imu_adapter", signal.SIGINT, 0.7),
    ],
)
def test_a_signal_in_the_midst_of_the_start_ends_an_executable_as_later(
    session, node, number, cpu_s
):
    """Moments are told by the CPU time since its first line: a busy machine hits the same one.

    The last of them is the end of the start, where that needs no more.
    """
    running = session("-c", ENTRY.format(node=node))
    assert running.until(lambda s: "on" in s.said(), "on")
    begun_s = running.cpu_s()
    running.until(
        lambda s: s.cpu_s() >= begun_s + cpu_s or "configuration:" in s.said(), "some CPU time"
    )
    running.send(number)
    ended = running.end()
    assert ended.code == 0 and "Traceback" not in ended.error


def test_an_impatient_ctrl_c_is_no_traceback_either(program):
    running = program("fusion")
    running.wait_for("configuration:")
    running.send(signal.SIGINT)
    running.send(signal.SIGINT)
    assert running.code() == 0
    assert "Traceback" not in running.output


def test_a_process_prints_its_help_and_ends_with_code_0(program):
    running = program("fusion", "--help")
    assert running.code() == 0
    assert "examples:" in running.output


def test_a_process_that_is_refused_prints_one_sentence_and_ends_with_code_2(program):
    running = program("fusion", "--ros-args", "-p", "zupt.std:=-1.0")
    assert running.code() == 2
    assert running.output.startswith("fusion: error: parameter 'zupt.std' is -1.0")
    assert running.output.count("\n") == 1


@pytest.mark.parametrize("node", SIGNALS)
def test_help_shows_examples_and_every_parameter_and_starts_nothing(program_here, node):
    running = program_here(node, "--help")
    assert running.code() == 0
    assert "examples:" in running.output and "ros2 run dualfoot_ros" in running.output
    assert "parameters" in running.output and "configuration:" not in running.output


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-p", "zupt.std:=-1.0"], "'zupt.std' is -1.0; allowed is a number in [0.0001, 1] m/s"),
        (["-p", "zupt.std:=much"], "'zupt.std' is 'much'; allowed is a number"),
        (["-p", "method:=magic"], "'method' is 'magic'; allowed is one of zupt"),
        (["-p", "use_sim_time:=maybe"], "'use_sim_time' to 'maybe'"),
        (["-p", "sync:=perhaps"], "'sync' is 'perhaps'; allowed is one of internal, external"),
        (["--params-file", "/no/such.yaml"], "/no/such.yaml"),
    ],
)
def test_a_bad_parameter_is_one_sentence_and_exit_code_2(program_here, arguments, said):
    running = program_here("fusion", "--ros-args", *arguments)
    assert running.code() == 2
    assert said in running.output and "fusion: error:" in running.output
    assert "Traceback" not in running.output


@pytest.fixture
def said(bench, capfd):
    """Return what fusion logs with certain arguments of ROS, as a process reads them."""

    def start(*arguments):
        bench.add(FusionNode, cli_args=["--ros-args", *map(str, arguments)])
        return capfd.readouterr().err

    return start


def test_a_whole_number_is_taken_for_a_real_one(said):
    assert "zupt.std=1.0" in said("-p", "zupt.std:=1")


def test_a_misspelt_parameter_is_warned_about_with_the_name_that_was_meant(said):
    warning = "'zupt.sdt' is not known and has no effect; did you mean 'zupt.std'?"
    assert warning in said("-p", "zupt.sdt:=0.1")


def test_a_parameter_of_another_node_in_the_same_file_is_no_misspelling(said, tmp_path):
    path = tmp_path / "all.yaml"
    path.write_text("/**:\n  ros__parameters:\n    mounting.yaw: 0.1\n    play.loop: true\n")
    output = said("--params-file", path)
    assert "configuration:" in output and "not known" not in output


def test_a_preset_reaches_a_node_in_a_namespace(said):
    output = said("--params-file", ROOT / "config/liu2023.yaml", "-r", "__ns:=/me")
    assert "[me.fusion]: configuration:" in output
    assert "idc.apply_at=detection" in output


def test_an_argument_that_is_not_for_ros_is_refused(program_here):
    running = program_here("fusion", "walk.bag")
    assert running.code() == 2
    assert "unrecognized arguments: walk.bag" in running.output


@pytest.mark.parametrize(
    ("node", "parameter", "said"),
    [
        ("replay", "bag:=/no/such/bag", "there is no bag '/no/such/bag'"),
        ("replay", "play.rate:=2.0", "parameter 'bag' is empty"),
        ("imu_adapter", "source:=imu", "allowed is topic:///NAME or file://PATH"),
        ("imu_adapter", "source:=serial:///dev/x", "add format= with one of mcu, ximu3"),
        ("imu_adapter", "source:=udp://:80?format=x", "format is 'x'; allowed is one of mcu"),
        ("imu_adapter", "source:=udp://here?format=mcu", "the address is 'here'; allowed is HOST"),
        ("imu_adapter", "source:=file:///no.bin?format=mcu", "'/no.bin' does not exist"),
        ("imu_adapter", "mounting.axes:=x,-y,z", "axes are 'x,-y,z': they mirror the sensor"),
        ("imu_adapter", "source:=file:///no/such.csv", "there is no file '/no/such.csv'"),
        ("imu_adapter", "source:=topic:///left foot", "'topic:///left foot' and names no topic"),
    ],
)
def test_a_source_that_is_not_there_is_one_sentence_and_exit_code_2(
    program_here, node, parameter, said
):
    running = program_here(node, "--ros-args", "-p", parameter)
    assert running.code() == 2
    assert said in running.output
    assert "Traceback" not in running.output


def test_publish_tf_without_tf2_msgs_is_refused_at_the_start(program_here):
    try:
        import tf2_msgs.msg  # noqa: F401
    except ImportError:
        running = program_here("fusion", "--ros-args", "-p", "publish_tf:=true")
        assert running.code() == 2
        assert "tf2_msgs cannot be imported" in running.output
    else:
        pytest.skip("tf2_msgs is installed here")


def test_an_input_without_publisher_is_named_within_seconds(program):
    running = program("fusion", "--ros-args", "-p", "input.silence:=0.5")
    running.wait_for("topic '/left/imu/data_raw' has no publisher")
    running.wait_for("topic '/right/imu/data_raw' has no publisher")
