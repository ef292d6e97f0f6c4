"""Write the parameter files of ``config/`` from the declared parameters: ``make config``."""

from __future__ import annotations

import sys
from pathlib import Path

from dualfoot_ros.core.config import all_specs
from dualfoot_ros.options import node_specs
from dualfoot_ros.parameter_files import parameter_file

CONFIG = Path(__file__).resolve().parent.parent / "config"
DEFAULT = """\
# Every parameter of the tracker with its default, as declared in dualfoot_ros/core/.
# Written by `make config`: change the declarations, not this file.

"""
NODES = """\
# Every parameter of the nodes with its default, as declared in dualfoot_ros/options.py; those of
# the tracker (config/default.yaml) may be added to any section, or stand below '/**:'.
# Written by `make config`: copy it, change the copy, and give it to bringup or to any node:
#   ros2 run dualfoot_ros bringup --ros-args --params-file mine.yaml

"""
SECTIONS = {
    "/**/bringup": "bringup",
    "/**/left/imu_adapter": "imu_adapter",
    "/**/right/imu_adapter": "imu_adapter",
    "/**/time_sync": "time_sync",
    "/**/fusion": "fusion",
    "/**/replay": "replay",
}


def main() -> int:
    """Write the files and name them."""
    for path, text in files().items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
        sys.stdout.write(f"wrote {path}\n")
    return 0


def files() -> dict[Path, str]:
    """Return the text of every generated file."""
    sections = [parameter_file(name, node_specs(node)) for name, node in SECTIONS.items()]
    return {
        CONFIG / "default.yaml": DEFAULT + parameter_file("/**", all_specs()),
        CONFIG / "nodes" / "bringup.yaml": NODES + "\n".join(sections),
    }


if __name__ == "__main__":
    sys.exit(main())
