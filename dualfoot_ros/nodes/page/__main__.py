"""``python -m dualfoot_ros.nodes.page``: the node ``live_page`` as ``dualfoot live`` starts it."""

import os
import signal
import sys
from typing import Any


def main() -> int:
    """Run the node; Ctrl-C ends it without a traceback, even while ROS is being imported."""
    signal.signal(signal.SIGINT, _end)
    from ..live_page import main as run

    return run()


def _end(*_: Any) -> None:
    os._exit(0)


if __name__ == "__main__":
    sys.exit(main())
