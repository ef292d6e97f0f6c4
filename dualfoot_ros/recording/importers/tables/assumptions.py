"""Assumptions about a table: what was taken for what, and where that came from."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from enum import StrEnum


class Origin(StrEnum):
    """Where an assumption comes from, the surest first."""

    OPTION = "option"
    NAME = "name of the column"
    HEADER = "header"
    LAYOUT = "layout"
    VALUES = "values"
    MOTION = "motion"
    DEFAULT = "default"


@dataclass(frozen=True)
class Assumption:
    """One thing that was taken for granted about a file.

    Attributes
    ----------
    foot : "left", "right" or "" for both
    subject : the thing: "time", "specific force", "delimiter" ...
    value : what it was taken for
    origin : where that comes from
    doubtful : whether the user should look at it
    """

    foot: str
    subject: str
    value: str
    origin: Origin
    doubtful: bool = False


def to_note(assumptions: Iterable[Assumption]) -> str:
    """Return them as one line of JSON, as the bag keeps them."""
    return json.dumps([asdict(assumption) for assumption in assumptions], ensure_ascii=False)


def from_note(note: str) -> list[Assumption]:
    """Return the assumptions that a bag keeps; none where the note is damaged."""
    try:
        items = json.loads(note)
        return [Assumption(**{**item, "origin": Origin(item["origin"])}) for item in items]
    except (ValueError, TypeError, KeyError):
        return []
