"""Distance of the feet in passing (c0), moment of passing (kappa), and step width of a walk.

From the tracks of two independent feet (method ``zupt``), so no constraint assumes the result.

- The lateral distance in passing comes from the turns of the walk (see
  :mod:`dualfoot_ros.inspection.lateral_spacing`).
- kappa, eq. (31) of Liu et al. 2023: with L_k the distance by which the swinging foot is ahead of
  the standing one at mid-stance and v its speed, the feet are abreast L_k / v before mid-stance.
  The error of the placement enters L_k with the sign of the foot that stands, so
  (L_k-1 + 2 L_k + L_k+1) / 4 is free of it, and of its drift.
- Step width and the height of the swinging foot are relative to the straight line between that
  foot's own footprints, so no gauge enters there either.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..core import (
    METHODS,
    MID_STANCE,
    CalibrationError,
    FloatArray,
    StancePassing,
    TrackerConfig,
    Trajectory,
    method_parameters,
    stance_passings,
)
from ..inspection import SideBySide, side_by_side, straight

LEAST_PASSINGS = 8
LEAST_STEPS = 3
CURVE_DEG = 25.0  # two steps in which the walk turns by less count for kappa
SEEN_STD_M = 0.05  # the spacing counts as seen when it is known this well
SWAPPED_SIGMAS = 3.0
SLOWEST = 0.5  # m/s
KAPPA = (0.2, 0.8)


@dataclass(frozen=True)
class SpacingFit:
    """The feet in passing on one walk.

    Attributes
    ----------
    feet : the lateral distance, its standard deviation, and the data behind them
    kappa, kappa_std : moment as a share of the stance, and its spread from step to step
    height_m : of the swinging foot's sensor at that moment
    step_bulge_m : by how much the swinging foot passes farther out than its footprints (negative:
        closer to the other foot)
    kappas : of each step on a straight part of the walk, each a mean over three steps
    passings : the moments that were used
    """

    feet: SideBySide
    kappa: float
    kappa_std: float
    kappas: tuple[float, ...]
    height_m: float
    step_bulge_m: float
    passings: tuple[StancePassing, ...]

    @property
    def seen(self) -> bool:
        """Whether the walk turned enough for the lateral distance to be observable."""
        return self.feet.std_m < SEEN_STD_M and self.feet.spacing_m > 0.0

    @property
    def swapped(self) -> bool:
        """Whether the left foot walks on the right of the right one."""
        return self.feet.sigmas < -SWAPPED_SIGMAS

    @property
    def c0_m(self) -> float:
        """Least distance of the two sensors, the height of the swinging foot included."""
        return math.hypot(self.feet.spacing_m, self.height_m)

    @property
    def step_width_m(self) -> float:
        """Lateral distance of successive footprints."""
        return self.feet.spacing_m - self.step_bulge_m

    def parameters(self) -> dict[str, Any]:
        """Return the parameters of every method that this fixes, by dotted name."""
        known = {"kappa": round(self.kappa, 3)}
        if self.seen:
            known["spacing"] = round(self.feet.spacing_m, 4)
            known["distance"] = round(self.c0_m, 4)
        return {
            spec.name: known[key]
            for method in METHODS
            for spec in method_parameters(method).specs(f"{method}.")
            if (key := spec.name.rpartition(".")[2]) in known
        }


def fit_spacing(trajectory: Trajectory, config: TrackerConfig | None = None) -> SpacingFit:
    """Return the fit of a walk tracked with ``config``, an ``unconstrained_config``.

    Raises
    ------
    CalibrationError
        When there are too few steps, or the feet are never abreast within a stance.
    """
    passings = stance_passings(trajectory)
    if len(passings) < LEAST_PASSINGS:
        raise CalibrationError(
            f"{len(passings)} steps were found in which one foot passes the other; needed are "
            f"{LEAST_PASSINGS}, so walk farther (and see 'dualfoot info' for the stances)"
        )
    details = [_Detail.of(trajectory, p) for p in passings]
    kappas = _kappas(passings, details, _lag(trajectory, config or TrackerConfig()))
    kappa = float(np.median(kappas))
    if not KAPPA[0] < kappa < KAPPA[1]:
        raise CalibrationError(
            f"the feet are abreast at {kappa:.2f} of the stance; allowed is {KAPPA[0]:g} to "
            f"{KAPPA[1]:g}, so the stances or the clocks of the feet are off"
        )
    return SpacingFit(
        feet=side_by_side(passings),
        kappa=kappa,
        kappa_std=_spread(kappas),
        kappas=tuple(kappas),
        height_m=float(np.median([d.height for d in details])),
        step_bulge_m=float(np.median([d.bulge for d in details])),
        passings=tuple(passings),
    )


@dataclass(frozen=True)
class _Detail:
    """One passing in numbers: m, m/s, s."""

    ahead: float
    speed: float
    stance_s: float
    height: float
    bulge: float

    @classmethod
    def of(cls, trajectory: Trajectory, passing: StancePassing) -> _Detail:
        tracks = (trajectory.left, trajectory.right)
        standing, swinging = tracks[passing.standing], tracks[1 - passing.standing]
        at = passing.epoch
        stamps = trajectory.left.stamp_ns
        apart = swinging.position[at] - standing.position[at]
        chord = _on_chord(swinging.position, passing.swing, at, passing.forward)
        outward = passing.left if passing.standing == 1 else -passing.left
        first, last = passing.stance
        return cls(
            ahead=float(apart[:2] @ passing.forward),
            speed=float(swinging.velocity[at, :2] @ passing.forward),
            stance_s=float(stamps[last] - stamps[first]) * 1e-9,
            height=float(swinging.position[at, 2] - chord[2]),
            bulge=float((swinging.position[at] - chord)[:2] @ outward),
        )


def _on_chord(
    position: FloatArray, swing: tuple[int, int], at: int, forward: FloatArray
) -> FloatArray:
    """Return the point (3,) beside ``position[at]`` on the line between two footprints."""
    begin, end = position[swing[0]], position[swing[1]]
    length = float((end - begin)[:2] @ forward)
    share = float((position[at] - begin)[:2] @ forward) / length if length > 0.0 else 0.5
    point: FloatArray = begin + min(1.0, max(0.0, share)) * (end - begin)
    return point


def _kappas(
    passings: Sequence[StancePassing], details: Sequence[_Detail], lag_s: float
) -> list[float]:
    """Return kappa of the steps on straight parts of the walk, each a mean over three."""
    kappas = []
    for k in range(1, len(passings) - 1):
        before, now, after = passings[k - 1 : k + 2]
        alternating = before.standing == after.standing != now.standing
        d = details[k]
        if (
            alternating
            and straight(before, after, CURVE_DEG)
            and d.speed > SLOWEST
            and d.stance_s > 0.0
        ):
            ahead = (details[k - 1].ahead + 2.0 * d.ahead + details[k + 1].ahead) / 4.0
            kappas.append(MID_STANCE + (lag_s - ahead / d.speed) / d.stance_s)
    if len(kappas) < LEAST_STEPS:
        raise CalibrationError(
            f"{len(kappas)} steps are on a straight part of the walk; needed are {LEAST_STEPS}, "
            "so walk some steps straight ahead"
        )
    return kappas


def _spread(kappas: Sequence[float]) -> float:
    """Return the spread of single steps from means of three with weights 1, 2, 1."""
    off = np.abs(np.array(kappas) - np.median(kappas))
    return 1.4826 * float(np.median(off)) / math.sqrt((1.0 + 4.0 + 1.0) / 16.0)


def _lag(trajectory: Trajectory, config: TrackerConfig) -> float:
    """Return the time from the middle of the detector's window to its end, s."""
    period = float(np.median(np.diff(trajectory.left.stamp_ns))) * 1e-9
    window = max(2, round(config.stance.window / period))
    return 0.5 * (window - 1) * period
