"""Entry points of the executables: a signal ends them also while Python imports the rest.

ROS takes some seconds to import on a small machine, and ``ros2 launch`` or a terminal may end a
node at any of them.  Nothing of ROS is imported before the signals can be answered.
"""

from __future__ import annotations

import importlib
import os
import signal
import sys
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM)
ADVICE = (
    "a node needs ROS 2: source its installation (setup.bash), or install the extra 'ros' of "
    "this package"
)


def bringup() -> int:
    """Run all nodes in one process."""
    return _run("bringup")


def fusion() -> int:
    """Run the node ``fusion``."""
    return _run("fusion")


def imu_adapter() -> int:
    """Run the node ``imu_adapter``."""
    return _run("imu_adapter")


def live_page() -> int:
    """Run the node ``live_page``."""
    return _run("live_page")


def replay() -> int:
    """Run the node ``replay``."""
    return _run("replay")


def time_sync() -> int:
    """Run the node ``time_sync``."""
    return _run("time_sync")


def _run(name: str) -> int:
    for number in SIGNALS:
        signal.signal(number, _leave)
    try:
        node = importlib.import_module(f".{name}", __package__)
    except ModuleNotFoundError as missing:
        if (missing.name or "").startswith(__package__.partition(".")[0]):
            raise  # a defect of this package, and no part of ROS
        sys.stderr.write(f"{name}: error: {missing.name} is not installed; {ADVICE}\n")
        return 2
    code: int = node.main()
    return code


def _leave(number: int, frame: FrameType | None) -> None:
    """End the process: nothing has been begun that is to be put in order."""
    os._exit(0)
