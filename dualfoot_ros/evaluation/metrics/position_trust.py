"""How long the position of a walk could be trusted, as the live node would have said."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import EventKind, FloatArray, IntArray, Trajectory, Trust, TrustTracker
from ..person_shares import person_covariance, person_position, person_shares

EVERY_S = 1.0


@dataclass(frozen=True)
class TrustReport:
    """The 95 % radius of the position over a walk, in the tracker's own frame.

    Attributes
    ----------
    limit_m : radius up to which a position is trusted
    radius_m : at the end of the walk
    trusted_way_m, trusted_s : way and time until the radius passed the limit; None when it did not
    way_left_m : at the end, straight ahead until it would; None for none
    """

    limit_m: float
    radius_m: float
    trusted_way_m: float | None
    trusted_s: float | None
    way_left_m: float | None


def trust_series(trajectory: Trajectory, limit_m: float) -> tuple[IntArray, list[Trust]]:
    """Return the (K,) epochs, about one a second, and what the position was worth at each."""
    headings = trajectory.of_kind(EventKind.HEADING)
    known_ns = max((e.detected_ns for e in headings if not e.turn.joint), default=0)
    stamps, tracker = trajectory.left.stamp_ns, TrustTracker(limit_m)
    epochs = trust_epochs(stamps)
    position = person_position(trajectory, epochs)[:, :2]
    covariance = person_covariance(trajectory, epochs)[:, :2, :2]
    variance = mean_heading_variance(trajectory, epochs)
    found = []
    for n, k in enumerate(epochs.tolist()):
        stamp_ns = int(stamps[k])
        known = stamp_ns >= known_ns
        tracker.add(stamp_ns, position[n], covariance[n], variance[n], heading_known=known)
        trust = tracker.result()
        assert trust is not None
        found.append(trust)
    return epochs, found


def trust_epochs(stamps: IntArray) -> IntArray:
    """Return the epochs (K,) of stamps (N,) ns at which the place is looked at, and the last."""
    wanted = np.arange(stamps[0], stamps[-1] + 1, round(EVERY_S * 1e9))
    epochs: IntArray = np.unique(np.append(np.searchsorted(stamps, wanted), len(stamps) - 1))
    return epochs


def mean_heading_variance(trajectory: Trajectory, epochs: IntArray) -> FloatArray:
    """Return the greatest variance (K,) rad^2 that the mean of both headings can have."""
    left, right = (
        np.sqrt(np.maximum(foot.attitude_covariance[epochs, 2, 2], 0.0))
        for foot in (trajectory.left, trajectory.right)
    )
    a, b = person_shares(trajectory, epochs)
    variance: FloatArray = (a * left + b * right) ** 2
    return variance


def trust_report(trajectory: Trajectory, limit_m: float) -> TrustReport:
    """Return how long the position could be trusted."""
    epochs, found = trust_series(trajectory, limit_m)
    middle = person_position(trajectory, epochs)[:, :2]
    way = np.append(0.0, np.cumsum(np.hypot(*np.diff(middle, axis=0).T)))
    lost = next((k for k, trust in enumerate(found) if not trust.trusted), None)
    start_ns = found[0].stamp_ns
    left = found[-1].way_left_m
    return TrustReport(
        limit_m,
        found[-1].radius_m,
        None if lost is None else float(way[lost]),
        None if lost is None else (found[lost].stamp_ns - start_ns) * 1e-9,
        left if math.isfinite(left) else None,
    )
