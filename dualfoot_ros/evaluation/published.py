"""The trajectory that the estimates published by a live tracker make up.

While a live graph runs, each estimate is published as it is known at its epoch.  Two things come
later: the heading of a foot (announced by a HEADING event once its first strides are made) and
the confirmed stance phases.  Both are in the published events, so the trajectory can be corrected
afterwards, as :meth:`dualfoot_ros.core.DualFootTracker.run` does it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from ..core import (
    FEET,
    EvaluationError,
    Event,
    EventKind,
    FloatArray,
    FootTrajectory,
    Trajectory,
    clean_stance,
)
from .frames.association import cut
from .frames.yaw_transform import YawTransform


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
    relative_covariance : (N, 3, 3) of left minus right position, where it is known

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
    feet = [_finished(track, kept, index) for index, track in enumerate((left, right))]
    if relative_covariance is None:
        relative_covariance = np.full((len(left), 3, 3), np.nan)
    start_ns = int(left.stamp_ns[0])
    return Trajectory(
        feet[0], feet[1], relative_covariance, kept, dict(counters or {}), start_ns, method
    )


def heading_transform(event: Event) -> YawTransform:
    """Return what a HEADING event does to the track of its foot so far."""
    yaw = float(event.detail["yaw"])
    pivot, shift = np.array(event.detail["pivot"]), np.array(event.detail["shift"])
    c, s = math.cos(yaw), math.sin(yaw)
    turned = np.array([c * pivot[0] - s * pivot[1], s * pivot[0] + c * pivot[1], pivot[2]])
    return YawTransform(yaw, pivot + shift - turned)


def _since_reset(events: Iterable[Event]) -> tuple[Event, ...]:
    kept: list[Event] = []
    for event in events:
        if event.kind is EventKind.RESET:
            kept.clear()
        kept.append(event)
    return tuple(kept)


def _finished(track: FootTrajectory, events: tuple[Event, ...], foot: int) -> FootTrajectory:
    for event in events:
        if event.kind is EventKind.HEADING and event.foot == FEET[foot]:
            before = track.stamp_ns < event.detected_ns
            turned = heading_transform(event).foot(cut(track, before))
            track = _joined(turned, cut(track, ~before))
    return replace(track, stance=clean_stance(track.stamp_ns, events, foot))


def _joined(first: FootTrajectory, then: FootTrajectory) -> FootTrajectory:
    parts = {
        name: np.concatenate([value, vars(then)[name]]) for name, value in vars(first).items()
    }
    return replace(first, **parts)
