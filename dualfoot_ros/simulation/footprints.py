"""Places and times of the landings of both feet: the plan of a walk, one row a landing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, SimulationError
from .routes import Route
from .walk_config import WalkConfig

# Shares of the time from heel-off to flat foot, as on real walks (docs/explanation/simulation.md).
TOE_OFF = 0.27
HEEL_STRIKE = 0.84
# The foot counts as standing from the last of the sole's slap to the first of the heel's rise:
# there its angular rate is below 0.8 rad/s, which is what detectors see.
STILL_FROM = 0.97
STILL_TO = 0.06
STAIR_CYCLE_S = 1.25


@dataclass(frozen=True)
class Footprints:
    """Landings in the order of time; rows 0 and 1 are the feet as they stand at the start.

    Attributes
    ----------
    side : (K,) +1 left, -1 right
    flat_s : (K,) s, when the foot has come to rest on the floor
    heel_off_s : (K,) s, when the heel began to leave the place before
    progress : (K,) m along the route
    lateral : (K,) m to the left of the route
    floor : (K,) m
    passes : (K,) bool, the foot passes the other one that stands
    stair : (K,) bool
    end_s : s, when the walker stands for good
    """

    side: FloatArray
    flat_s: FloatArray
    heel_off_s: FloatArray
    progress: FloatArray
    lateral: FloatArray
    floor: FloatArray
    passes: np.ndarray
    stair: np.ndarray
    end_s: float

    def rows_of(self, side: int) -> np.ndarray:
        """Return the rows of one foot; side +1 left, -1 right."""
        return np.flatnonzero(self.side == side)

    def stances_of(self, side: int) -> FloatArray:
        """Return (M, 2) s: start and end of each stance, the first from 0, the last to the end."""
        rows = self.rows_of(side)
        start, end = self.stance_start_s[rows], self.stance_end_s[rows[1:]]
        return np.column_stack([start, np.append(end, self.end_s)])

    @property
    def stance_start_s(self) -> FloatArray:
        """When the foot counts as standing where it landed, (K,) s."""
        return self.flat_s - (1.0 - STILL_FROM) * (self.flat_s - self.heel_off_s)

    @property
    def stance_end_s(self) -> FloatArray:
        """When the foot ceases to stand at the place before, (K,) s."""
        return self.heel_off_s + STILL_TO * (self.flat_s - self.heel_off_s)


def step_share(stance_share: float) -> float:
    """Return the share of the cycle from heel-off to rest that leaves this share of stance."""
    return (1.0 - stance_share) / (STILL_FROM - STILL_TO)


def plan(config: WalkConfig, route: Route, rng: np.random.Generator) -> Footprints:
    """Return the landings of a walk along ``route``.

    Raises
    ------
    SimulationError
        When there are more stops than the route has room for.
    """
    progress, stair = _landings(route, config.step_length)
    bouts = _bouts(progress, stair, config.stops)
    walker = _Walker(config, rng)
    for first, last in bouts:
        walker.walk(progress[first:last], stair[first:last])
    return walker.footprints(route)


def _landings(route: Route, step: float) -> tuple[FloatArray, np.ndarray]:
    """Return progress (K,) m and stair (K,) of every step: even steps on flats, one a tread."""
    progress: list[float] = [0.0]
    stair: list[bool] = [False]
    flat = 0.0
    for piece in (*route.pieces, None):
        if piece is not None and piece.treads == 0:
            flat += piece.length
            continue
        count = max(1, round(flat / step)) if flat > 0 else 0
        start = progress[-1]
        progress += [start + flat * k / count for k in range(1, count + 1)]
        stair += [False] * count
        flat = 0.0
        if piece is not None:
            start = progress[-1]
            going = piece.length / piece.treads
            progress += [start + going * k for k in range(1, piece.treads + 1)]
            stair += [True] * piece.treads
    return np.array(progress[1:]), np.array(stair[1:], dtype=bool)


def _bouts(progress: FloatArray, stair: np.ndarray, stops: int) -> list[tuple[int, int]]:
    """Return the first and one-past-last step of each stretch between two stops."""
    if stops * 6 > len(progress):
        raise SimulationError(
            f"stops is {stops}; on this route of {len(progress)} steps allowed is "
            f"0 to {len(progress) // 6}"
        )
    if len(progress) == 0:
        return []
    places = progress[-1] * np.arange(1, stops + 1) / (stops + 1)
    distance = np.abs(progress[None, :] - places[:, None]) + 1e3 * stair[None, :]
    ends = np.unique(np.append(np.argmin(distance, axis=1) + 1, len(progress)))
    return list(zip(np.append(0, ends[:-1]).tolist(), ends.tolist(), strict=True))


class _Walker:
    """Collects landings bout by bout; between two bouts the walker stands with feet together."""

    def __init__(self, config: WalkConfig, rng: np.random.Generator) -> None:
        self.config = config
        self.rng = rng
        self.now = config.standing
        half = 0.5 * config.gait.standing_width
        self.rows: list[tuple[float, float, float, float, float, bool, bool]] = [
            (+1.0, 0.0, 0.0, 0.0, +half, False, False),
            (-1.0, 0.0, 0.0, 0.0, -half, False, False),
        ]

    def walk(self, progress: FloatArray, stair: np.ndarray) -> None:
        """Walk the steps, left foot first, close the feet, and stand for the stop's duration."""
        last = 0.0
        start = len(self.rows)
        for index, (place, on_stair) in enumerate(zip(progress, stair, strict=True)):
            cycle = max(self.config.cycle_s, STAIR_CYCLE_S if on_stair else 0.0)
            last = self._next_flat(last, cycle)
            side = 1.0 if index % 2 == 0 else -1.0
            along, across = self._scatter(on_stair)
            lateral = side * (0.5 * self.config.gait.step_width + across)
            heel_off = self._heel_off(start, last, cycle)
            flags = index > 0, bool(on_stair)
            self.rows.append((side, last, heel_off, place + along, lateral, *flags))
        side = -self.rows[-1][0]
        last = self._next_flat(last, self.config.cycle_s)
        lateral = 0.5 * side * self.config.gait.standing_width
        place = self.rows[-1][3]
        heel_off = self._heel_off(start, last, self.config.cycle_s)
        self.rows.append((side, last, heel_off, place, lateral, False, False))
        self.now = last + self.config.stop_duration

    def footprints(self, route: Route) -> Footprints:
        """Return the collected landings, ended by the final standstill."""
        side, flat, heel_off, progress, lateral, passes, stair = np.array(self.rows).T
        return Footprints(
            side=side,
            flat_s=flat,
            heel_off_s=heel_off,
            progress=progress,
            lateral=lateral,
            floor=route.floor(progress),
            passes=passes.astype(bool),
            stair=stair.astype(bool),
            end_s=max(float(flat.max()), self.config.standing) + self.config.final_standing,
        )

    def _next_flat(self, last: float, cycle: float) -> float:
        gait = self.config.gait
        if last == 0.0:
            return self.now + step_share(gait.stance_share) * cycle
        return last + 0.5 * cycle * (1.0 + gait.cycle_std * self._normal())

    def _scatter(self, on_stair: bool) -> tuple[float, float]:
        spread = self.config.gait.footprint_std * (0.25 if on_stair else 1.0)
        return spread * self._normal(), 0.5 * spread * self._normal()

    def _heel_off(self, start: int, flat: float, cycle: float) -> float:
        """Return when the heel left the ground for the step that ends at ``flat``."""
        gait = self.config.gait
        if len(self.rows) >= start + 2:
            cycle = flat - self.rows[-2][1]
        share = gait.stance_share + gait.stance_share_std * self._normal()
        return flat - step_share(share) * cycle

    def _normal(self) -> float:
        """Return a standard normal number, cut at 2.5."""
        return float(np.clip(self.rng.standard_normal(), -2.5, 2.5))
