"""The trajectory that the estimates published by a live tracker make up.

While a live graph runs, each estimate is published as it is known at its epoch.  Two things come
later: the heading of a foot (announced by a HEADING event once its first strides are made) and
the confirmed stance phases.  Both are in the published events, so the trajectory can be corrected
afterwards, as :meth:`dualfoot_ros.core.DualFootTracker.run` does it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..core import (
    FEET,
    Covariances,
    EvaluationError,
    Event,
    EventKind,
    FloatArray,
    FootTrajectory,
    Trajectory,
    clean_stance,
)


def published_trajectory(
    left: FootTrajectory,
    right: FootTrajectory,
    events: Iterable[Event],
    *,
    method: str,
    counters: Mapping[str, int] | None = None,
    relative_covariance: FloatArray | None = None,
) -> Trajectory:
    """Return the trajectory of both feet as published, turned by the HEADING events since.

    Parameters
    ----------
    left, right : one row a published message, in its frame of that time; ``stance`` is replaced
    events : all events that were published, in order
    relative_covariance : (N, 3, 3) of left minus right position as published, where it is known

    Raises
    ------
    EvaluationError
        When the feet do not have the same stamps, or there is no estimate at all.
    """
    if not np.array_equal(left.stamp_ns, right.stamp_ns) or len(left) == 0:
        raise EvaluationError(
            f"the feet were published at different stamps ({len(left)} and {len(right)} "
            "estimates); equal stamps are needed, at least one"
        )
    kept = _since_reset(events)
    feet = {"left": left, "right": right}
    if relative_covariance is None:
        relative_covariance = np.full((len(left), 3, 3), np.nan)
    for event in kept:
        if event.kind is EventKind.HEADING:
            relative_covariance = _apply_heading(event, feet, relative_covariance)
    tracks = [
        replace(feet[foot], stance=clean_stance(left.stamp_ns, kept, index))
        for index, foot in enumerate(FEET)
    ]
    start_ns = int(left.stamp_ns[0])
    relative = Covariances.of(relative_covariance)
    return Trajectory(tracks[0], tracks[1], relative, kept, dict(counters or {}), start_ns, method)


def _since_reset(events: Iterable[Event]) -> tuple[Event, ...]:
    kept: list[Event] = []
    for event in events:
        if event.kind is EventKind.RESET:
            kept.clear()
        kept.append(event)
    return tuple(kept)


def _apply_heading(
    event: Event, feet: dict[str, FootTrajectory], relative: FloatArray
) -> FloatArray:
    """Turn the track of a foot as a HEADING event says; return the covariance of left minus right.

    Until both headings are known the feet are uncorrelated, so that the covariance (N, 3, 3)
    changes as the foot's own does; when both feet turn together (``joint``), it turns as a whole,
    with the left one.
    """
    track, turn = feet[event.foot], event.turn
    before = track.stamp_ns < event.detected_ns
    turned = track.cut(before).turned(turn)
    feet[event.foot] = _joined(turned, track.cut(~before))
    relative = np.array(relative)
    if not turn.joint:
        relative[before] += turned.position_covariance - track.position_covariance[before]
    elif event.foot == FEET[0]:
        relative[before] = turn.covariances(relative[before])
    return relative


def _joined(first: FootTrajectory, then: FootTrajectory) -> FootTrajectory:
    parts: dict[str, Any] = {
        name: np.concatenate([value, vars(then)[name]]) for name, value in vars(first).items()
    }
    return replace(first, **parts)
