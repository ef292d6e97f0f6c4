"""Stances of both feet in figures, their turns, and the configuration without constraints."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core import (
    BoolArray,
    FloatArray,
    FootTrajectory,
    TrackerConfig,
    Trajectory,
    median,
    picked,
    stance_bounds,
)

STEP_STANCE_S = 1.2  # a longer stance is a stand
LONGEST_CYCLE_S = 2.0
LEAST_STRIDE_M = 0.5  # of a foot that walks while the other one stands


@dataclass(frozen=True)
class StanceStatistics:
    """The stances of one foot.

    Attributes
    ----------
    count : their number
    median_s : s, median length; nan without stances
    share : of the walk (from the end of the first stance to the start of the last), 0 to 1
    distance_m : m, walked from stance to stance
    """

    count: int
    median_s: float
    share: float
    distance_m: float


@dataclass(frozen=True)
class TurnTaking:
    """How the feet take turns, by the stamps of their samples.

    Attributes
    ----------
    cycles : of the left foot, each between two stances of the right one
    cycle_s : s, their median length
    late_s : s, how much later than half a cycle after the left foot the right one stands, between
        minus and plus half a cycle; nan without cycles
    steadiness : 1 where that is the same in every cycle, 0 where it is anything
    leads : at each start strides of the left foot before the right one moves, minus the reverse;
        at each stop strides of the right foot after the left one stands, minus the reverse
    """

    cycles: int
    cycle_s: float
    late_s: float
    steadiness: float
    leads: tuple[int, ...]


def turn_taking(trajectory: Trajectory) -> TurnTaking:
    """Return how the feet take turns in a walk."""
    left, right = _Stances.of(trajectory.left), _Stances.of(trajectory.right)
    before = np.searchsorted(right.middle_s, left.middle_s) - 1
    inside = (before >= 0) & (before + 1 < len(right.middle_s))
    before, middle_s = before[inside], left.middle_s[inside]
    cycle_s = picked(right.middle_s, before + 1) - picked(right.middle_s, before)
    steps = left.is_step[inside] & picked(right.is_step, before)
    steps &= picked(right.is_step, before + 1) & (cycle_s < LONGEST_CYCLE_S)
    leads = (*_leads(left, right), *(-lead for lead in _leads(right, left)))
    if not steps.any():
        return TurnTaking(0, float("nan"), float("nan"), 0.0, leads)
    share = ((middle_s - picked(right.middle_s, before)) / cycle_s)[steps]
    mean = complex(np.exp(2j * math.pi * (0.5 - share)).mean())
    usual_s = median(cycle_s[steps])
    late_s = math.atan2(mean.imag, mean.real) / (2.0 * math.pi) * usual_s
    return TurnTaking(int(steps.sum()), usual_s, late_s, abs(mean), leads)


@dataclass(frozen=True)
class _Stances:
    """The stances of a foot: (M,) s when each begins and ends, and the (M - 1,) m between them."""

    begin_s: FloatArray
    end_s: FloatArray
    stride_m: FloatArray

    @classmethod
    def of(cls, foot: FootTrajectory) -> _Stances:
        bounds = stance_bounds(foot.stance)
        places = picked(foot.position, (bounds[:, 0] + bounds[:, 1] - 1) // 2)[:, :2]
        seconds = (foot.stamp_ns[bounds - [0, 1]] - foot.stamp_ns[0]) * 1e-9
        ways = np.linalg.norm(np.diff(places, axis=0), axis=1)
        return cls(seconds[:, 0], seconds[:, 1], ways)

    @property
    def middle_s(self) -> FloatArray:
        return 0.5 * (self.begin_s + self.end_s)

    @property
    def is_step(self) -> BoolArray:
        return (self.end_s - self.begin_s) < STEP_STANCE_S


def _leads(foot: _Stances, other: _Stances) -> list[int]:
    """Return the strides of ``foot`` in each stand of ``other``: before its walk, or minus after.

    Stands are compared in which ``foot`` stands, too.
    """
    found = []
    number, long = np.arange(len(foot.stride_m)), foot.stride_m >= LEAST_STRIDE_M
    lifted, landed = foot.end_s[:-1], foot.begin_s[1:]
    for stand in np.flatnonzero(~other.is_step):
        begin_s, end_s = other.begin_s[stand], other.end_s[stand]
        rests = np.flatnonzero(~foot.is_step & (foot.begin_s < end_s) & (foot.end_s > begin_s))
        if not len(rests):
            continue
        if stand > 0:
            found.append(-int((long & (number < rests[0]) & (landed > begin_s)).sum()))
        if stand + 1 < len(other.end_s):
            found.append(int((long & (number >= rests[-1]) & (lifted < end_s)).sum()))
    return [lead for lead in found if lead]


def unconstrained_config(config: TrackerConfig | None = None) -> TrackerConfig:
    """Return the configuration that tracks each foot by itself, with stances as in ``config``.

    Two such tracks can be compared.  Only the parameters of standstills and stances, and where the
    sensors sit, are taken over.  A constraint or an aid would bend the tracks (a magnetic field
    turns with each sensor's own iron), and so would another noise or first heading: how far two
    tracks drift apart is known of the default filter alone.
    """
    config = config or TrackerConfig()
    return TrackerConfig(
        method="zupt",
        gravity=config.gravity,
        increments=config.increments,
        alignment=config.alignment,
        stance=config.stance,
        zupt=config.zupt,
    )


def stance_statistics(trajectory: Trajectory) -> dict[str, StanceStatistics]:
    """Return the statistics of both feet by name."""
    return {"left": _summarise(trajectory.left), "right": _summarise(trajectory.right)}


def _summarise(foot: FootTrajectory) -> StanceStatistics:
    bounds = stance_bounds(foot.stance)
    if not len(bounds):
        return StanceStatistics(0, float("nan"), 0.0, 0.0)
    lengths = (foot.stamp_ns[bounds[:, 1] - 1] - foot.stamp_ns[bounds[:, 0]]) * 1e-9
    walk = slice(bounds[0, 1], bounds[-1, 0])
    share = float(foot.stance[walk].mean()) if walk.stop > walk.start else 0.0
    return StanceStatistics(len(bounds), median(lengths), share, foot.distance_m)
