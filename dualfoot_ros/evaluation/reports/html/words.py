"""The findings of a walk in words: what was walked, how good the track is, what to look at."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from ...tracked_person import PersonTrack
from ...whole_evaluation import Evaluation
from ..walk_table import number

CLIMB_M = 0.5
"""Less height than this may be drift."""

EQUAL_PERCENT = 0.05
"""A smaller asymmetry would be printed as zero."""


class Tone(StrEnum):
    """How a sentence is shown; its value is the class of the page's style."""

    PLAIN = "plain"
    GOOD = "good"
    WARNING = "warning"


@dataclass(frozen=True)
class Sentence:
    """One finding in words."""

    text: str
    tone: Tone = Tone.PLAIN


def in_words(run: Evaluation, person: PersonTrack) -> list[Sentence]:
    """Return the findings of a walk, the most important first."""
    parts = (
        _warnings(run),
        _walk(run, person),
        _errors(run, person),
        _closing(run),
        _height(person),
        _gait(run),
        _notes(run),
    )
    return [sentence for part in parts for sentence in part]


def _warnings(run: Evaluation) -> Iterator[Sentence]:
    for finding in run.findings:
        yield Sentence(f"{_capital(finding.sentence)}.", Tone.WARNING)
    if run.run_s is not None and not run.findings:
        yield Sentence("The checks of the recording found nothing suspicious.", Tone.GOOD)


def _walk(run: Evaluation, person: PersonTrack) -> Iterator[Sentence]:
    strides = len(run.gait.strides)
    feet = run.tracked_feet
    whose = "both feet together" if len(feet) > 1 else f"the {''.join(feet)} foot alone"
    yield Sentence(
        f"The person walked {person.walked_m[-1]:.1f} m in {duration(person)}, "
        f"with {strides} strides of {whose} (method {run.trajectory.method})."
    )


def _capital(sentence: str) -> str:
    return f"{sentence[:1].upper()}{sentence[1:]}"


def duration(person: PersonTrack) -> str:
    """Return the time of a walk in minutes and seconds."""
    minutes, seconds = divmod(_seconds(person), 60)
    return f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def clock(person: PersonTrack) -> str:
    """Return the time of a walk in the few letters of a tile."""
    minutes, seconds = divmod(_seconds(person), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours}:{minutes:02d}:{seconds:02d} h"
    return f"{minutes}:{seconds:02d} min" if minutes else f"{seconds} s"


def _seconds(person: PersonTrack) -> int:
    return round((int(person.stamp_ns[-1]) - int(person.stamp_ns[0])) * 1e-9)


def _errors(run: Evaluation, person: PersonTrack) -> Iterator[Sentence]:
    report = run.truth_report
    radius = float(person.at(slice(-1, None)).radius_95_m[-1])
    claim = f"the filter claims to know the place at the end within {radius:.2f} m (95 %)"
    if report is None:
        yield Sentence(f"There is no truth to compare with; horizontally, {claim}.")
    else:
        end = report.midpoint
        yield Sentence(
            f"Against the truth the track is {number(end.end_m)} m off at the end "
            f"({number(end.end_percent)} % of the way); the RMSE over the walk is "
            f"{number(end.rmse_m)} m, {number(end.rmse_horizontal_m)} m horizontally and "
            f"{number(end.rmse_vertical_m)} m in height. Horizontally, {claim}."
        )
    for foot, markers in run.marker_report.items():
        if markers.errors_m:
            yield Sentence(
                f"At the floor markers the {foot} foot is {number(markers.rmse_m)} m off (RMSE), "
                f"at most {number(markers.max_m)} m."
            )


def _closing(run: Evaluation) -> Iterator[Sentence]:
    gap = run.closure
    if gap is None:
        return
    share = f"{number(gap.mean_m)} m ({number(gap.mean_percent)} % of the way)"
    if run.closed_loop:
        yield Sentence(f"The walk is a loop, and the track closes within {share}.")
    elif run.truth is None:
        yield Sentence(
            f"From start to end it is {share}; if the walk was a loop, this is its error."
        )


def _height(person: PersonTrack) -> Iterator[Sentence]:
    floor = person.floor_m - person.floor_m[0]
    low, high, end = float(floor.min()), float(floor.max()), float(floor[-1])
    if high - low < CLIMB_M:
        yield Sentence(f"The floor of the track is level within {high - low:.2f} m.")
        return
    yield Sentence(
        f"The height lies between {low:+.2f} m and {high:+.2f} m of the start; the walk ends at "
        f"{end:+.2f} m."
    )


def _gait(run: Evaluation) -> Iterator[Sentence]:
    own = run.gait.parameters
    length, cadence = own["stride_length_m"], own["cadence_steps_per_min"].both.mean
    speed, stance = own["speed_m_per_s"].both.mean, own["stance_time_s"].symmetry_percent
    if length.both.mean is None:
        yield Sentence("There are too few steady strides for gait parameters.")
        return
    walking = (
        f"In steady walking strides are {number(length.both.mean)} m long at "
        f"{number(cadence, 0)} steps/min and {number(speed)} m/s"
    )
    yield Sentence(f"{walking}; {_symmetry(stance)}." if stance is not None else f"{walking}.")


def _symmetry(percent: float) -> str:
    if abs(percent) < EQUAL_PERCENT:
        return "both feet stand equally long"
    longer, other = ("right", "left") if percent >= 0 else ("left", "right")
    return (
        f"the stance of the {longer} foot is {abs(percent):.1f} % longer than that of the {other}"
    )


def _notes(run: Evaluation) -> Iterator[Sentence]:
    crossed = run.feet.crossed_percent
    if crossed:
        yield Sentence(
            f"At {number(crossed, 1)} % of the passings the tracks of the feet are crossed."
        )
    warned = {f"warning: {finding.sentence}" for finding in run.findings}
    for note in run.notes:
        if note not in warned:
            yield Sentence(f"{_capital(note)}.")
