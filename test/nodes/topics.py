"""The table of topics in docs/reference/topics_and_frames.md."""

import re
from dataclasses import dataclass
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reference" / "topics_and_frames.md"
NAMES = r"`([^`]+)`"


@dataclass(frozen=True)
class Row:
    """What the table says of a topic."""

    type: str
    published_by: frozenset[str]
    taken_by: frozenset[str]
    rate: str
    frame: str
    qos: str
    meaning: str


def table() -> dict[str, Row]:
    """Return the rows by the names of their topics."""
    text = PAGE.read_text(encoding="utf-8").partition("## Topics")[2].partition("\n## ")[0]
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    found = {}
    for line in rows:
        topics, kind, publishers, subscribers, *rest = (
            cell.strip() for cell in line.strip("|").split(" | ")
        )
        row = Row(kind, _nodes(publishers), _nodes(subscribers), *rest)
        found |= dict.fromkeys(re.findall(NAMES, topics), row)
    return found


def _nodes(cell: str) -> frozenset[str]:
    return frozenset(name.strip() for name in cell.split(",") if name.strip())
