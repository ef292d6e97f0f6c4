"""Lateral distance of the feet, left positive, from two tracks without constraints between them.

In a standstill and along a straight line it is unobservable, since the place where each track
starts is a gauge.  In a turn it is observable, as in
:mod:`dualfoot_ros.core.constraints.learnt_spacing`.  This is the offline form, for walks that are
long or whose feet may have been exchanged: the spacing may have either sign, and the ways in which
two tracks drift apart are estimated with it.  At passing k, with n the unit vector to the left of
the walk, f forward, and s the spacing, the separation (left minus right) is

    u_k = s n_k + a_k + d g_k f_k + noise,    g = +1 when the right foot stands, else -1,
    a_k+1 = a_k + delta J w_k + epsilon w_k + wander,

where a is the error of the placement, w the way from one passing to the next, J a quarter turn to
the left, delta the difference of the tracks' headings, epsilon that of their scales, and d by how
much the moment taken for the passing is early or late.  A Kalman filter estimates (s, a, delta,
epsilon, d).  A turn lets the navigation filter correct the heading it had so far and with
it the place, so the wander grows in turns with the way walked; a jump beyond that is taken as a
new placement.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..core import StancePassing
from .spacing_filter import DELTA, S, SpacingFilter

LEAST_STEPS = 5  # steps; fewer have no scatter
FARTHEST_HEADING = 0.5  # rad; tracks that differ by more are not used


class SideBySide(NamedTuple):
    """The estimate and the data behind it.

    Attributes
    ----------
    spacing_m, std_m : lateral distance of the feet in passing, left positive
    passings : number of those used
    turned_rad : span of the headings of the walk
    jumps : number of times that the tracks were placed anew
    scatter_m : standard deviation of the lateral distance from step to step
    heading_difference_rad : of left minus right track, at the end
    halves_agree : neither half of the walk alone says the opposite by more than its deviation
    """

    spacing_m: float
    std_m: float
    passings: int
    turned_rad: float
    jumps: int
    scatter_m: float
    heading_difference_rad: float
    halves_agree: bool = True

    @property
    def sigmas(self) -> float:
        """The estimate in units of its standard deviation."""
        return self.spacing_m / self.std_m


def side_by_side(passings: Sequence[StancePassing]) -> SideBySide:
    """Estimate the spacing from the passings of a walk; without turns it stays at 0 +- 0.3 m."""
    filter_, used, first = _run(passings)
    if used < len(passings):
        first = _run(passings[: used // 2])[0]
    sign = math.copysign(1.0, filter_.x[S])
    halves = (first, _run(passings[used // 2 : used])[0])
    headings = np.unwrap([math.atan2(p.forward[1], p.forward[0]) for p in passings[:used]])
    return SideBySide(
        spacing_m=filter_.x[S],
        std_m=filter_.std_m,
        passings=used,
        turned_rad=float(np.ptp(headings)) if used else 0.0,
        jumps=filter_.jumps,
        scatter_m=_scatter(passings[:used]),
        heading_difference_rad=filter_.x[DELTA],
        halves_agree=all(sign * half.x[S] > -half.std_m for half in halves),
    )


def _run(passings: Sequence[StancePassing]) -> tuple[SpacingFilter, int, SpacingFilter]:
    """Return the filter after the passings, the number of those it used, and it at half of all."""
    filter_, used = SpacingFilter(), 0
    half = filter_.copy()
    for passing in passings:
        if used == len(passings) // 2:
            half = filter_.copy()
        filter_.add(passing)
        used += 1
        if abs(filter_.x[DELTA]) > FARTHEST_HEADING:
            break
    return filter_, used, half


def _scatter(passings: Sequence[StancePassing]) -> float:
    """Return the step-to-step scatter (m) of the lateral distance where the walk was straight.

    From second differences over one foot's steps, so that a steady drift does not count.
    """
    bends = [
        float((c.separation - 2.0 * b.separation + a.separation) @ b.left)
        for a, b, c in zip(passings[:-4], passings[2:-2], passings[4:], strict=True)
        if a.standing == b.standing == c.standing and straight(a, c)
    ]
    if len(bends) < LEAST_STEPS:
        return float("nan")
    return float(1.4826 * np.median(np.abs(bends)) / math.sqrt(6.0))


def straight(first: StancePassing, last: StancePassing, within_deg: float = 10.0) -> bool:
    """Return whether the walk went on in the same direction."""
    return float(first.forward @ last.forward) > math.cos(math.radians(within_deg))
