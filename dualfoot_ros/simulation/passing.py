"""The moments at which one foot passes the other: found on the motion, and tuned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray
from .footprints import HEEL_STRIKE, TOE_OFF, Footprints
from .motion import Walker
from .routes import Route
from .shoe import ShoeMotion
from .walk_config import Mount, WalkConfig

Motions = tuple[ShoeMotion, ShoeMotion]  # left, right

ROUNDS = 4
SIDES = (1, -1)  # of the left and the right shoe
EDGE = 0.02  # share of a stance in which a least distance at its end is none


@dataclass(frozen=True)
class Passes:
    """Moments of least distance between the two sensors, one a step that passes the other foot.

    Attributes
    ----------
    time_s : (M,) s
    distance : (M,) m, least distance of the two sensors
    kappa : (M,) moment within the stance of the standing foot, eq. (30) of Liu et al. 2023
    standing_side : (M,) +1 where the left foot stands, -1 where the right one does
    """

    time_s: FloatArray
    distance: FloatArray
    kappa: FloatArray
    standing_side: FloatArray


NO_PASSES = Passes(np.empty(0), np.empty(0), np.empty(0), np.empty(0))


@dataclass(frozen=True)
class PassPlan:
    """Steps that pass a standing foot, and the wanted moment and distance of each pass.

    ``row`` (M,) is the landing, ``start`` and ``end`` (M,) s bound the stance of the other foot,
    ``time_s`` (M,) and ``distance`` (M,) m are wanted where ``free`` (M,), which is not on stairs:
    there the treads fix the places of the feet.
    """

    row: np.ndarray
    start: FloatArray
    end: FloatArray
    time_s: FloatArray
    distance: FloatArray
    free: np.ndarray


def pass_plan(
    config: WalkConfig, route: Route, prints: Footprints, rng: np.random.Generator
) -> PassPlan:
    """Draw moment and distance of every pass."""
    gait = config.gait
    row = np.flatnonzero(prints.passes)
    start, end = prints.stance_start_s[row - 1], prints.stance_end_s[row + 1]
    scatter = np.clip(rng.standard_normal((2, len(row))), -2.5, 2.5)
    kappa = gait.kappa + gait.kappa_std * scatter[0]
    turn = np.abs(route.heading(prints.progress[row]) - route.heading(prints.progress[row - 1]))
    distance = config.min_distance + gait.min_distance_std * scatter[1]
    return PassPlan(
        row=row,
        start=start,
        end=end,
        time_s=start + kappa * (end - start),
        distance=distance + gait.turn_widening * turn,
        free=~(prints.stair[row - 1] | prints.stair[row] | prints.stair[row + 1]),
    )


def tuned(walkers: tuple[Walker, Walker], prints: Footprints, wanted: PassPlan) -> Motions:
    """Return motions whose passes come when and as close as wanted.

    Skew and bulge of every swing are adjusted for that.
    """
    motions = (walkers[0].motion(), walkers[1].motion())
    if len(wanted.row) == 0:
        return motions
    swing = (HEEL_STRIKE - TOE_OFF) * (prints.flat_s[wanted.row] - prints.heel_off_s[wanted.row])
    near = np.maximum(wanted.time_s - 0.12, wanted.start), wanted.time_s + 0.12
    search = Search(motions, walkers[0].config.mount, moments(*near, 49))
    for _ in range(ROUNDS):
        time_s, distance = search.least(motions)
        for walker in walkers:
            mine = wanted.free & (prints.side[wanted.row] == walker.side)
            at = np.searchsorted(walker.rows, wanted.row[mine])
            late = ((time_s - wanted.time_s) / swing)[mine]
            near_by = (wanted.distance - distance)[mine]
            walker.skew[at] = np.clip(walker.skew[at] + late, -0.15, 0.15)
            walker.bulge[at] = np.clip(walker.bulge[at] + near_by, -0.08, 0.12)
        motions = (walkers[0].motion(), walkers[1].motion())
    return motions


class Search:
    """Finds the passes of motions that turn the shoes alike, one each in the rows of ``grid``."""

    def __init__(self, motions: Motions, mount: Mount, grid: FloatArray) -> None:
        self._grid = grid
        self._arms = tuple(
            shoe.arm(grid.ravel(), mount.lever_of(side))
            for shoe, side in zip(motions, SIDES, strict=True)
        )

    def least(self, motions: Motions) -> tuple[FloatArray, FloatArray]:
        """Return moment (M,) s and distance (M,) m of the passes."""
        time_s = self._grid.ravel()
        left, right = (m.ball(time_s) + a for m, a in zip(motions, self._arms, strict=True))
        return least(self._grid, left - right)


def moments(start: FloatArray, end: FloatArray, count: int) -> FloatArray:
    """Return ``count`` even times (M, count) s between ``start`` and ``end`` (M,)."""
    grid: FloatArray = start[:, None] + (end - start)[:, None] * np.linspace(0.0, 1.0, count)
    return grid


def least(grid: FloatArray, apart: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return moment (M,) s and distance (M,) m of the least of the vectors ``apart``.

    They hold at the times ``grid`` (M, C), row after row; the least of a row is refined by the
    parabola through it and its neighbours.
    """
    squared = np.einsum("ni,ni->n", apart, apart).reshape(grid.shape)
    row = np.arange(len(grid))
    at = np.clip(np.argmin(squared, axis=1), 1, grid.shape[1] - 2)
    low, mid, high = squared[row, at - 1], squared[row, at], squared[row, at + 1]
    bend = np.maximum(low - 2.0 * mid + high, 1e-12)
    shift = np.clip(0.5 * (low - high) / bend, -1.0, 1.0)
    moment = grid[row, at] + shift * (grid[:, 1] - grid[:, 0])
    best = mid - 0.25 * (low - high) * shift
    return moment, np.sqrt(np.maximum(best, 0.0))


def passes(motions: Motions, config: WalkConfig, prints: Footprints, plan: PassPlan) -> Passes:
    """Return the passes as they truly are: the least distance within each stance.

    Where the distance only falls or only rises (on some stairs) there is no pass.
    """
    if len(plan.row) == 0:
        return NO_PASSES
    grid = moments(plan.start, plan.end, 161)
    left, right = (
        shoe.position(grid.ravel(), config.mount.lever_of(side))
        for shoe, side in zip(motions, SIDES, strict=True)
    )
    time_s, distance = least(grid, left - right)
    kappa = (time_s - plan.start) / (plan.end - plan.start)
    inside = (kappa > EDGE) & (kappa < 1.0 - EDGE)
    return Passes(time_s[inside], distance[inside], kappa[inside], -prints.side[plan.row[inside]])
