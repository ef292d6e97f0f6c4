"""The findings of a comparison in words: which method is best by which figure, and by how much."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ....core import TrackerConfig
from ..comparison_rows import over_bags, values
from ..walk_table import number
from .words import Sentence, Tone

JUDGED = {
    "midpoint_rmse_m": "error against the truth (RMSE)",
    "right_marker_rmse_m": "error at the floor markers (RMSE)",
    "closure_mean_m": "closure",
}
"""Figures by which methods are judged, the most telling first."""

CROSSED_PERCENT = 5.0
"""Tracks of feet that cross more often than this are named."""

Rows = Sequence[Mapping[str, Any]]


def ranking(cases: Mapping[str, Rows], figure: str) -> list[tuple[float, str]]:
    """Return (median, case) of a figure in the order of their size."""
    known = ((over_bags([dict(row) for row in rows], figure), c) for c, rows in cases.items())
    return sorted((error, case) for error, case in known if error is not None)


def in_words(cases: Mapping[str, Rows], failures: Mapping[str, str]) -> Iterator[Sentence]:
    """Yield the findings: what failed, who is best by each figure, whose feet cross."""
    for name, reason in failures.items():
        yield Sentence(f"{name} gave no figures: {reason}.", Tone.WARNING)
    judged = [figure for figure in JUDGED if ranking(cases, figure)]
    if not judged:
        yield Sentence(
            "The recordings have no truth, no floor markers and no closed loop, so nothing tells "
            "which method is best here."
        )
    for index, figure in enumerate(judged):
        tone = Tone.PLAIN if index else Tone.GOOD
        yield Sentence(_judgement(cases, figure), tone)
    yield from _crossed(cases)


def _judgement(cases: Mapping[str, Rows], figure: str) -> str:
    order = ranking(cases, figure)
    (least, best), (most, worst) = order[0], order[-1]
    if len(order) > 1 and number(least) == number(most):
        alike = f"All {len(order)} have the same {JUDGED[figure]}: {number(least)} m"
        return f"{alike}{_of_how_many(cases, figure)}."
    text = f"{best} has the smallest {JUDGED[figure]}: {number(least)} m"
    default = TrackerConfig().method
    own = {case: error for error, case in order}
    if default in own and default not in (best, worst):
        text += f"; {default}, the default, has {number(own[default])} m"
    if worst != best:
        text += f"; {worst} has the largest: {number(most)} m"
    return f"{text}{_of_how_many(cases, figure)}."


def _of_how_many(cases: Mapping[str, Rows], figure: str) -> str:
    """Return in how many recordings a figure is known, where not in all."""
    rows = max(cases.values(), key=len)
    known = len(values([dict(row) for row in rows], figure))
    return f" ({known} of {len(rows)} recordings have this figure)" if known < len(rows) else ""


def _crossed(cases: Mapping[str, Rows]) -> Iterator[Sentence]:
    crossed = [
        f"{case} ({number(share, 0)} %)"
        for share, case in ranking(cases, "feet_crossed_percent")
        if share > CROSSED_PERCENT
    ]
    if crossed:
        yield Sentence(
            f"Feet that pass on the wrong side of each other at more than {CROSSED_PERCENT:.0f} % "
            f"of the passings: {', '.join(reversed(crossed))}."
        )
