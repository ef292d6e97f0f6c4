"""The kinds of findings that a room of the package makes, read off its source."""

import re
from pathlib import Path

from dualfoot_ros.inspection import FindingKind

PACKAGE = Path(__file__).resolve().parents[2] / "dualfoot_ros"


def kinds_made_in(room):
    """Return the kinds that the modules of ``room`` name."""
    sources = [path.read_text(encoding="utf-8") for path in (PACKAGE / room).rglob("*.py")]
    names = {name for text in sources for name in re.findall(r"\bFindingKind\.([A-Z_]+)", text)}
    return {FindingKind[name] for name in names}
