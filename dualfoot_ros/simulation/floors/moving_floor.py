"""Floors that move under the walker: lift, vehicle, escalator, moving walkway.

The walk is made on a floor at rest; then each shoe is moved on by the way of the floor while it
stands on it.  A foot that steps on or off goes over from one floor to the other in its swing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ...core import FloatArray, Parameters, SimulationError, parameter
from ..shoe import ShoeMotion
from ..walk import Walk

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

STANDING_KINDS = ("lift", "vehicle")  # they start and end while the walker stands in them
INCLINE_RAD = np.radians(30.0)  # of an escalator
LEVEL_S, RAMP_S = 1.0, 1.2  # of its way that is level at both ends, and bends into the incline
LEAST_SLOPE = 1.875  # greatest slope of the smooth step
WAIT_S = 3.0  # from the last step to the start of a lift or vehicle


@dataclass(frozen=True)
class MovingFloorConfig(Parameters):
    """A floor that carries the walker: during the first stop, or while walking on it."""

    kind: str = parameter(
        "lift", "what moves", choices=("lift", "vehicle", "escalator", "walkway")
    )
    speed: float = parameter(1.0, "of the floor", unit="m/s", minimum=0.1, maximum=40.0)
    acceleration: float = parameter(
        1.0, "greatest, of a lift or vehicle", unit="m/s^2", minimum=0.1, maximum=5.0
    )
    way: float = parameter(
        12.0,
        "of a lift (up, negative down) or vehicle (ahead)",
        unit="m",
        minimum=-1000.0,
        maximum=10000.0,
    )
    walking: bool = parameter(
        False, "walk on the escalator or walkway from 0.3 to 0.7 of the steps, without a stop"
    )


def on_moving_floor(walked: Walk, config: MovingFloorConfig) -> Walk:
    """Return the walk with both shoes carried by a moving floor.

    Raises
    ------
    SimulationError
        When the walk has no stop to stand on the floor, or the stop is too short for the way.
    """
    if config.kind in STANDING_KINDS:
        moves = [_ride(walked, config, shoe) for shoe in walked.shoes]
    else:
        moves = [
            _transport(walked, config, shoe, side)
            for shoe, side in zip(walked.shoes, walked.sides, strict=True)
        ]
    left, right = (_moved(s, m) for s, m in zip(walked.shoes, moves, strict=True))
    return replace(walked, shoes=(left, right))


def _moved(shoe: ShoeMotion, move: FloatArray) -> ShoeMotion:
    """Return the motion with the control points moved by ``move`` (K, 3) m."""
    from scipy.interpolate import BSpline

    spline = shoe.spline
    points = spline.c.copy()
    points[:, :3] += move
    return ShoeMotion(BSpline(spline.t, points, spline.k), shoe.gravity)


def _times(spline: BSpline) -> FloatArray:
    """Return the abscissae (K,) s of the control points (Greville)."""
    k, count = spline.k, len(spline.c)
    means: FloatArray = np.mean([spline.t[i : i + count] for i in range(1, k + 1)], axis=0)
    return means


def _stop_row(walked: Walk) -> int:
    """Return the row of the landing after which the walker stands on the way.

    Raises
    ------
    SimulationError
        When the walk has no stop.
    """
    prints = walked.footprints
    if walked.config.stops < 1:
        raise SimulationError("stops is 0; a moving floor to stand on needs at least 1")
    still = prints.heel_off_s[3:] - prints.flat_s[2:-1]
    return 2 + int(np.argmax(still >= 0.5 * walked.config.stop_duration))


def _ride(walked: Walk, config: MovingFloorConfig, shoe: ShoeMotion) -> FloatArray:
    """Return the way (K, 3) m of a lift or vehicle in the first stop."""
    row, prints = _stop_row(walked), walked.footprints
    ramp_s = LEAST_SLOPE * config.speed / config.acceleration
    cruise_s = abs(config.way) / config.speed - ramp_s
    start = float(prints.flat_s[row]) + WAIT_S
    end = start + 2.0 * ramp_s + cruise_s
    if cruise_s < 0.0 or end > prints.heel_off_s[row + 1] - 1.0:
        raise SimulationError(
            f"a way of {config.way:g} m takes {end - start:.0f} s or a lower speed; "
            f"stop_duration is {walked.config.stop_duration:g} s"
        )
    time_s = _times(shoe.spline)
    share = _smooth((time_s - start) / ramp_s) - _smooth((time_s - end + ramp_s) / ramp_s)
    return np.outer(_integral(time_s, config.speed * share), _ahead(walked, config, row))


def _ahead(walked: Walk, config: MovingFloorConfig, row: int) -> FloatArray:
    """Return the direction (3,) in which the floor moves at a landing."""
    if config.kind == "lift":
        return np.array([0.0, 0.0, np.sign(config.way)])
    heading = float(walked.route.heading(walked.footprints.progress[row : row + 1])[0])
    return np.array([np.cos(heading), np.sin(heading), 0.0])


def _transport(walked: Walk, config: MovingFloorConfig, shoe: ShoeMotion, side: int) -> FloatArray:
    """Return the way (K, 3) m of a shoe on an escalator or walkway."""
    prints = walked.footprints
    if config.walking:
        board, leave = (round(share * len(prints.flat_s)) for share in (0.3, 0.7))
    else:
        board = _stop_row(walked) - 1
        leave = board + 2
    begin, end = float(prints.flat_s[board]), float(prints.flat_s[leave])
    time_s = _times(shoe.spline)
    rows = prints.rows_of(side)
    on, off = (
        _between_floors(walked, time_s, int(rows[np.searchsorted(rows, row)]))
        for row in (board, leave)
    )
    way = _floor_way(walked, config, time_s, (begin, end), board)
    last = _floor_way(walked, config, np.array([begin, end]), (begin, end), board)[1]
    moved: FloatArray = on[:, None] * ((1.0 - off)[:, None] * way + off[:, None] * last)
    return moved


def _floor_way(
    walked: Walk,
    config: MovingFloorConfig,
    time_s: FloatArray,
    span: tuple[float, float],
    row: int,
) -> FloatArray:
    """Return the way (K, 3) m of the floor since ``span[0]``, and before it."""
    begin, end = span
    incline = INCLINE_RAD if config.kind == "escalator" else 0.0
    way = np.outer(config.speed * np.cos(incline) * (time_s - begin), _ahead(walked, config, row))
    fine = np.arange(begin, end + 0.01, 0.01)
    climbing = _smooth((fine - begin - LEVEL_S) / RAMP_S) - _smooth(
        (fine - end + LEVEL_S + RAMP_S) / RAMP_S
    )
    way[:, 2] = np.interp(time_s, fine, _integral(fine, config.speed * np.sin(incline) * climbing))
    return way


def _between_floors(walked: Walk, time_s: FloatArray, row: int) -> FloatArray:
    """Return (K,) 0 before the swing to a landing, 1 after it."""
    prints = walked.footprints
    start, end = prints.heel_off_s[row], prints.flat_s[row]
    return _smooth((time_s - start) / (end - start))


def _smooth(share: FloatArray) -> FloatArray:
    """Return a step from 0 to 1, twice continuously differentiable."""
    x = np.clip(share, 0.0, 1.0)
    step: FloatArray = x**3 * (10.0 - 15.0 * x + 6.0 * x * x)
    return step


def _integral(time_s: FloatArray, rate: FloatArray) -> FloatArray:
    """Return the integral (K,) of ``rate`` (K,) over ``time_s`` by the trapezoidal rule."""
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(time_s)
    return np.append(0.0, np.cumsum(steps))
