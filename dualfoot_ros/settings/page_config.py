"""Parameters of the live page, declared here without any ROS."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import Parameters, parameter

LOOPBACK = "127.0.0.1"
PAGE_PORT = 8770


@dataclass(frozen=True)
class PageConfig(Parameters):
    """Parameters of the node ``live_page``: where the page is served."""

    host: str = parameter(
        LOOPBACK,
        "address to serve on; any but 127.0.0.1 and ::1 lets others in the network read the page",
    )
    port: int = parameter(PAGE_PORT, "port to serve on; 0: any free one", minimum=0, maximum=65535)
    open: bool = parameter(False, "open the page in the browser of this machine")
