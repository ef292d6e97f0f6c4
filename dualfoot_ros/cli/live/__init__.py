"""``dualfoot live``: the page of the node ``live_page``, for people without the tools of ROS."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from importlib.util import find_spec

from ...core import ConfigError
from ...settings import LOOPBACK, PAGE_PORT

HELP = "a page in the browser that shows a walk while the nodes track it"
EXAMPLES = f"""\
examples:
  dualfoot live --open                       http://{LOOPBACK}:{PAGE_PORT}/ in the browser
  dualfoot live --port 9000                  on another port; 0 takes any free one
  dualfoot live --namespace /anna            of two people, the one whose nodes are in /anna

Start bringup or fusion beside it, as 'ros2 run dualfoot_ros bringup'.  The page shows what they
publish, and says what is missing.  It is served to this machine only, and changes nothing.
Ctrl-C ends it, with exit code 0; 2 says that the page cannot be served, or that ROS is missing.
"""
NODE = "dualfoot_ros.nodes.page"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "--port", type=int, default=PAGE_PORT, help="port of the page (default: %(default)s)"
    )
    parser.add_argument(
        "--host",
        default=LOOPBACK,
        help="address to serve on; any but the default lets others read it (default: %(default)s)",
    )
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    parser.add_argument("--namespace", default="", help="namespace of the nodes (default: none)")


def run(args: argparse.Namespace) -> int:
    """Become the node: signals and exit code are its own.

    Raises
    ------
    ConfigError
        When rclpy cannot be imported.
    """
    if find_spec("rclpy") is None:
        raise ConfigError(
            "the page needs ROS 2: source its installation (setup.bash), or install the extra "
            "'ros' of this package"
        )
    sys.stdout.flush()
    command = [sys.executable, "-m", NODE, *_node_arguments(args)]
    os.execv(sys.executable, command)  # noqa: S606 - no shell is wanted


def _node_arguments(args: argparse.Namespace) -> Iterator[str]:
    yield "--ros-args"
    for name in ("host", "port", "open"):
        value = getattr(args, name)
        yield from ("-p", f"{name}:={str(value).lower() if name == 'open' else value}")
    if args.namespace:
        yield from ("-r", f"__ns:=/{args.namespace.strip('/')}")
