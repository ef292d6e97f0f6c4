"""Entries of a comparison made by formula: two recordings, two methods."""

from __future__ import annotations

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.evaluation import evaluate
from dualfoot_ros.evaluation.batch import Case, Entry
from dualfoot_ros.evaluation.batch.comparison import _tracks
from dualfoot_ros.evaluation.reports import flat

from ..walks import perfect, rectangle


def entries_of() -> list[Entry]:
    """Return the entries."""
    track, truth = perfect(rectangle())
    run = evaluate(track, truth=truth)
    return [
        Entry(bag, Case(name, TrackerConfig(), None), run.to_dict(), None, None, 0.1, _tracks(run))
        for bag in ("one", "two")
        for name in ("zupt", "idc")
    ]


def rows_of(entries: list[Entry]) -> list[dict]:
    """Return their flat rows."""
    return [flat(entry) for entry in entries]
