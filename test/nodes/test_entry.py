"""What an executable says where ROS 2 is missing."""

import importlib
import signal

import pytest

from dualfoot_ros.nodes import entry


@pytest.mark.parametrize("node", ["bringup", "fusion", "live_page"])
def test_without_ros_an_executable_says_in_a_sentence_what_to_install(node, monkeypatch, capsys):
    def missing(name, package):
        raise ModuleNotFoundError("No module named 'rclpy'", name="rclpy")

    monkeypatch.setattr(importlib, "import_module", missing)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    assert getattr(entry, node)() == 2
    said = capsys.readouterr().err
    assert said.startswith(f"{node}: error: rclpy is not installed; a node needs ROS 2")
    assert said.count("\n") == 1


def test_a_module_of_this_package_that_is_missing_is_a_defect_and_not_hidden(monkeypatch):
    def missing(name, package):
        raise ModuleNotFoundError("No module named 'dualfoot_ros.x'", name="dualfoot_ros.x")

    monkeypatch.setattr(importlib, "import_module", missing)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    with pytest.raises(ModuleNotFoundError):
        entry.fusion()
