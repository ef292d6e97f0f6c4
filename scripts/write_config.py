"""Write ``config/default.yaml`` from the declared parameters: ``make config``."""

from __future__ import annotations

import sys
from pathlib import Path

from dualfoot_ros.core.config import all_specs
from dualfoot_ros.parameter_files import parameter_file

TARGET = Path(__file__).resolve().parent.parent / "config" / "default.yaml"
HEADER = """\
# Every parameter of the tracker with its default, as declared in dualfoot_ros/core/.
# Written by `make config`: change the declarations, not this file.

"""


def main() -> int:
    """Write the file and say so."""
    TARGET.write_text(default_yaml(), encoding="utf-8")
    sys.stdout.write(f"wrote {TARGET}\n")
    return 0


def default_yaml() -> str:
    """Return the text of the file."""
    return HEADER + parameter_file("/**", all_specs())


if __name__ == "__main__":
    sys.exit(main())
