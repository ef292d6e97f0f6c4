"""Node ``live_page``: a page in the browser that shows a walk while it is walked."""

from __future__ import annotations

import ipaddress
import sys
import webbrowser
from contextlib import suppress
from typing import Any

from rclpy.node import Node

from ..settings import PageConfig, node_specs
from .page.live_state import LiveState
from .page.page_document import live_page
from .page.page_inputs import PageInputs
from .page.page_server import PageServer
from .ros.declared_parameters import declare, group
from .ros.program import Graph, Program, run_nodes

PROGRAM = Program(
    "live_page",
    "Show in a browser what fusion publishes: track, height, feet, trust, errors, warnings.\n"
    "The page is served to this machine only, unless host says otherwise, and only read.",
    "  ros2 run dualfoot_ros live_page --ros-args -p open:=true\n"
    "  ros2 run dualfoot_ros live_page --ros-args -p port:=9000 -r __ns:=/anna\n"
    "  dualfoot live --open",
    tuple(node_specs("live_page")),
)


class LivePageNode(Node):
    """Node that serves the page."""

    def __init__(self, **options: Any) -> None:
        """Take the options of :class:`rclpy.node.Node`.

        Raises
        ------
        ConfigError
            For bad parameters, and when the page cannot be served there.
        """
        super().__init__("live_page", **options)
        config = group(PageConfig, declare(self, node_specs("live_page")))
        state = LiveState()
        self.inputs = PageInputs(self, state)
        self.server = PageServer(config.host, config.port, state, live_page())
        self.get_logger().info(f"the page is at {self.server.url} (Ctrl-C ends it)")
        if not _is_loopback(config.host):
            self.get_logger().warning(
                f"the page is served on {config.host}: everybody in that network can read it"
            )
        if config.open:
            webbrowser.open(self.server.url)

    def destroy_node(self) -> None:
        """Free the port, and end."""
        if hasattr(self, "server"):
            self.server.close()
        super().destroy_node()


def _is_loopback(host: str) -> bool:
    with suppress(ValueError):
        return ipaddress.ip_address(host).is_loopback
    return host == "localhost"


def main() -> int:
    """Run the node."""
    return run_nodes(PROGRAM, lambda: Graph([LivePageNode()]))


if __name__ == "__main__":
    sys.exit(main())
