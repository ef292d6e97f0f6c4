"""Write ``config/*.yaml`` and ``docs/reference/parameters.md``: ``make config``."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from dualfoot_ros.core.config import all_specs
from dualfoot_ros.core.parameters import ParameterSpec
from dualfoot_ros.settings.files import parameter_file
from dualfoot_ros.settings.nodes import node_specs

ROOT = Path(__file__).resolve().parent.parent
CONFIG = ROOT / "config"
DEFAULT = """\
# Every parameter of the tracker with its default, as declared in dualfoot_ros/core/.
# Written by `make config`: change the declarations, not this file.

"""
NODES = """\
# Every parameter of the nodes with its default, as declared in dualfoot_ros/settings/nodes.py;
# those of the tracker (config/default.yaml) may be added to any section, or stand below '/**:'.
# Written by `make config`: copy it, change the copy, and give it to bringup or to any node:
#   ros2 run dualfoot_ros bringup --ros-args --params-file mine.yaml

"""
TABLES = """\
# Parameters

All parameters with default, allowed values and meaning. A name is written dotted (`--set
zupt.std=0.02`) or nested (YAML). A value out of range is refused with its name, the value and what
is allowed. A name that does not exist is refused offline; the nodes warn of it.

`make config` writes this page from the declarations in `dualfoot_ros/core/` and
`dualfoot_ros/settings/nodes.py`: change those, not the page.

"""
SECTIONS = {
    "/**/bringup": "bringup",
    "/**/left/imu_adapter": "imu_adapter",
    "/**/right/imu_adapter": "imu_adapter",
    "/**/time_sync": "time_sync",
    "/**/fusion": "fusion",
    "/**/replay": "replay",
    "/**/live_page": "live_page",
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
        ROOT / "docs" / "reference" / "parameters.md": TABLES + tables(),
    }


def tables() -> str:
    """Return a table of the tracker's parameters and one for each node."""
    parts = [table("Tracker (offline verbs, and the node `fusion`)", all_specs())]
    nodes = dict.fromkeys(SECTIONS.values())
    parts += [table(f"Node `{node}`", node_specs(node)) for node in nodes]
    return "\n".join(parts)


def table(title: str, specs: Iterable[ParameterSpec]) -> str:
    """Return a Markdown table of ``specs``."""
    lines = [f"## {title}", "", "| name | default | allowed | meaning |", "|---|---|---|---|"]
    for spec in specs:
        shown = f"`{shown_default(spec)}`" if spec.default != "" else ""
        lines.append(f"| `{spec.name}` | {shown} | {spec.allowed} | {spec.description} |")
    return "\n".join([*lines, ""])


def shown_default(spec: ParameterSpec) -> str:
    """Return a default as YAML has it."""
    if isinstance(spec.default, bool):
        return str(spec.default).lower()
    return str(list(spec.default) if isinstance(spec.default, tuple) else spec.default)


if __name__ == "__main__":
    sys.exit(main())
