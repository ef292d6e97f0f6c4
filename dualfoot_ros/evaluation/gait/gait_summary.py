"""Gait parameters of a whole walk: mean, variability and symmetry over its steady strides."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core import FEET
from .strides import Stride

PARAMETERS = {
    "stride_length_m": "stride length (m)",
    "step_length_m": "step length (m)",
    "step_width_m": "step width (m)",
    "stride_time_s": "stride time (s)",
    "stance_time_s": "stance time (s)",
    "swing_time_s": "swing time (s)",
    "stance_percent": "stance (% of the stride)",
    "step_time_s": "step time (s)",
    "cadence_steps_per_min": "cadence (steps/min)",
    "speed_m_per_s": "speed (m/s)",
    "clearance_m": "foot clearance (m)",
    "contact_deg": "foot angle at contact (deg)",
    "lift_off_deg": "foot angle at lift-off (deg)",
    "turn_deg": "turning angle (deg)",
}
"""Names of the parameters that are summed up, and their words for people."""

SIGNED = ("turn_deg", "step_width_m")
"""Parameters whose mean may be near zero, so that shares of it say nothing."""

LEAST_STRIDES = 2


@dataclass(frozen=True)
class Spread:
    """Mean and variability of one parameter; None where there are too few strides.

    ``std`` is the standard deviation from stride to stride; over both feet it is the root of the
    mean of their variances, so that a limp does not count as variability (Galna et al. 2013).
    ``cv_percent`` is the standard deviation in percent of the mean.
    """

    count: int
    mean: float | None
    std: float | None
    cv_percent: float | None


@dataclass(frozen=True)
class ParameterSummary:
    """One parameter of both feet, and its symmetry index.

    ``symmetry_percent`` is ``(right - left) / (0.5 (right + left)) 100`` of the means (Robinson et
    al. 1987): 0 is symmetric, positive more on the right.
    """

    left: Spread
    right: Spread
    both: Spread
    symmetry_percent: float | None


@dataclass(frozen=True)
class Gait:
    """Gait parameters of a walk.

    Attributes
    ----------
    strides : of both feet, all of them, in the order of time
    parameters : name -> summary over the steady strides
    """

    strides: tuple[Stride, ...]
    parameters: dict[str, ParameterSummary]

    def count(self, foot: str, *, steady: bool = False) -> int:
        """Return the number of (steady) strides of a foot."""
        return sum(s.foot == foot and (s.steady or not steady) for s in self.strides)


def summarise(strides: Sequence[Stride]) -> Gait:
    """Sum up strides over those that are steady."""
    steady = [stride for stride in strides if stride.steady]
    return Gait(tuple(strides), {name: _summary(steady, name) for name in PARAMETERS})


def _summary(steady: Sequence[Stride], name: str) -> ParameterSummary:
    signed = name in SIGNED
    left, right = (
        _spread([getattr(s, name) for s in steady if s.foot == f], signed) for f in FEET
    )
    return ParameterSummary(
        left, right, _both(left, right, signed), _symmetry(left, right, signed)
    )


def _spread(values: Sequence[float], signed: bool) -> Spread:
    known = np.array([value for value in values if math.isfinite(value)])
    if len(known) < LEAST_STRIDES:
        return Spread(len(known), float(known[0]) if len(known) else None, None, None)
    mean, std = float(known.mean()), float(known.std(ddof=1))
    return Spread(len(known), mean, std, _share(std, mean, signed))


def _both(left: Spread, right: Spread, signed: bool) -> Spread:
    count = left.count + right.count
    if left.mean is None or right.mean is None:
        one = right if left.mean is None else left
        return Spread(count, one.mean, one.std, one.cv_percent)
    mean = (left.mean + right.mean) / 2
    if left.std is None or right.std is None:
        return Spread(count, mean, None, None)
    std = math.sqrt((left.std**2 + right.std**2) / 2)
    return Spread(count, mean, std, _share(std, mean, signed))


def _share(std: float, mean: float, signed: bool) -> float | None:
    return None if signed or mean == 0.0 else 100.0 * std / abs(mean)


def _symmetry(left: Spread, right: Spread, signed: bool) -> float | None:
    if signed or left.mean is None or right.mean is None or left.mean + right.mean == 0.0:
        return None
    return 100.0 * (right.mean - left.mean) / abs(0.5 * (right.mean + left.mean))
