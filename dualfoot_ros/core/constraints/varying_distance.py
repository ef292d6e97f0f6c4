"""``varying_distance``: a bound on the distance that follows the gait (VDC).

Ma and Särkkä 2023, III-B: over the moving period of a foot the bound gamma_k is a flipped
Gaussian, symmetric about feet adjacent (FA), from ``maximum`` at the ends to ``minimum`` at FA;
beyond it the moving foot is pulled back as in eq. (4).  FA is the peak of the moving foot's
horizontal angular rate (II-A).  Both are known when the foot has landed, so the period is then run
again from its start.  The paper gives sigma = 5 without a unit; here it is samples at its 60 Hz.

It gives no bounds that suit everybody: a minimum below the distance at which a person passes the
feet turns every step.  So unless they are given they come from the walk, the minimum from the
learnt spacing and the maximum from the length of the strides, each with a margin.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..parameters import Parameters, parameter
from ..results.payloads import DistanceLimit, Passing
from ..samples.series import FloatArray
from .learnt_spacing import Spacing
from .max_distance_projection import pull
from .method import Gait, Method, Request, StancePhase


@dataclass(frozen=True)
class VaryingDistanceConfig(Parameters):
    """Parameters of the varying distance constraint."""

    maximum: float = parameter(
        0.0,
        "bound at the ends of the moving period (0: from the strides of the walk)",
        unit="m",
        minimum=0.0,
        maximum=3.0,
    )
    minimum: float = parameter(
        0.0,
        "bound when the feet are adjacent (0: learnt from the walk)",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    sigma: float = parameter(
        0.0833, "width of the flipped Gaussian", unit="s", minimum=0.005, maximum=1.0
    )
    max_swing: float = parameter(
        1.5, "a longer moving period is no step", unit="s", minimum=0.2, maximum=3.0
    )


FIRST_STEP_M = 0.9  # before a stride is known
SWING_S = 0.5  # before one is known
STRIDES = 6  # of each foot; the longest of them counts
LONGER_STEP = 1.3  # a step against half a stride, at most
STEP_TO_STEP_M = 0.04  # by which a foot may pass farther out than it does usually
MOMENT_S = 0.1  # to which the peak of the angular rate tells the moment of passing
PASSING_SPEED = 1.5  # of the moving foot in passing, against its mean speed


class Strides:
    """The longest of the last strides of both feet."""

    def __init__(self) -> None:
        """Start with no stride."""
        self._last: list[FloatArray | None] = [None, None]
        self._lengths: deque[float] = deque(maxlen=2 * STRIDES)

    def add(self, foot: int, position: FloatArray) -> None:
        """Take the position (3,) m at which ``foot`` came to stand."""
        before, self._last[foot] = self._last[foot], position
        if before is not None:
            self._lengths.append(float(np.linalg.norm((position - before)[:2])))

    def step_m(self) -> float | None:
        """Return the longest step that these strides let expect, None before the first."""
        return 0.5 * LONGER_STEP * max(self._lengths) if self._lengths else None

    def forget_places(self) -> None:
        """Take note that the tracks were moved."""
        self._last = [None, None]


class VaryingDistance(Method):
    """Bounds the distance over each moving period, once the foot has landed."""

    name = "varying_distance"
    config_class = VaryingDistanceConfig
    config: VaryingDistanceConfig

    def __init__(self, config: VaryingDistanceConfig) -> None:
        """Use ``config``."""
        self.config = config
        self.memory_s = config.max_swing
        self.spacing: Spacing = Spacing(config.minimum)
        self._strides = Strides()
        self._pulled = np.zeros(2)
        self._swings: deque[float] = deque([SWING_S], maxlen=2 * STRIDES)

    def on_stance_start(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return one pull for every epoch of the moving period that has just ended."""
        if gait.remembers(stance.first):
            self._strides.add(stance.foot, gait.positions_after(stance.first)[stance.foot])
        start = gait.last_stance_end(stance.foot) + 1
        epochs = range(start, stance.first)
        too_long = len(epochs) * stance.period_s > self.config.max_swing
        if start <= 0 or not epochs or too_long or not gait.remembers(start):
            return ()
        self._swings.append(len(epochs) * stance.period_s)
        adjacent = feet_adjacent(gait, stance.foot, epochs)
        bounds = self.bounds()
        return [
            Request(
                e,
                True,
                partial(
                    bounded,
                    moving=stance.foot,
                    bound=self.bound(e - adjacent, stance, bounds),
                    heading=stance.heading,
                    passing=e == adjacent,
                ),
            )
            for e in epochs
            if gait.in_stance(1 - stance.foot, e)
        ]

    def bounds(self) -> tuple[float, float]:
        """Return the least and the largest bound in m, as given or as the walk shows them."""
        step = self._strides.step_m() or FIRST_STEP_M
        beside = self.spacing.value_m + STEP_TO_STEP_M
        ahead = MOMENT_S * PASSING_SPEED * 2.0 * step / float(np.median(self._swings))
        least = self.config.minimum or math.hypot(beside, ahead)
        return least, max(self.config.maximum or math.hypot(step, beside), least)

    def note(self, outcome: Outcome) -> None:
        """Learn the spacing, if it was not given, from the passing as it is without pulls."""
        pulled = outcome.payload
        if not isinstance(pulled, Passing):
            return
        if self.spacing.learner is not None and pulled.lateral is not None:
            free = (np.array(pulled.before[:2]) - self._pulled).tolist()
            self.spacing.learner.add(free, free, pulled.heading)
        self._pulled += np.array(pulled.after[:2]) - np.array(pulled.before[:2])

    def moved(self, up_m: float, turned: float) -> None:
        """Learn the placement anew."""
        self.spacing.moved()
        self._strides.forget_places()
        self._pulled[:] = 0.0

    def bound(
        self, offset: int, stance: StancePhase, bounds: tuple[float, float] | None = None
    ) -> float:
        """Return gamma_k in m, ``offset`` epochs from feet adjacent (default: present bounds)."""
        least, largest = self.bounds() if bounds is None else bounds
        x = offset * stance.period_s / self.config.sigma
        return largest - (largest - least) * math.exp(-0.5 * x * x)


def bounded(
    estimate: JointEstimate, moving: int, bound: float, heading: float, passing: bool
) -> Outcome:
    """Pull foot ``moving`` to ``bound`` m; ``passing`` says that the feet are adjacent now."""
    before = estimate.relative_position()
    outcome = pull(estimate, moving, bound)
    limit = outcome.payload
    assert isinstance(limit, DistanceLimit)
    lateral = -math.sin(heading) * before[0] + math.cos(heading) * before[1]
    payload = Passing(
        limit, heading, before, estimate.relative_position(), lateral if passing else None
    )
    return outcome._replace(payload=payload)


def feet_adjacent(gait: Gait, foot: int, epochs: range) -> int:
    """Return the epoch at which the moving foot passes the standing one.

    The swing turns the foot about its lateral axis twice, backwards while it is thrown forward
    and the other way at both ends; the forward throw's peak is where the feet are adjacent.  The
    lateral axis is that of the largest angular rate over the moving period.
    """
    rates = np.array([gait.sample(foot, e)[3:] for e in epochs])
    axis = np.linalg.eigh(rates.T @ rates)[1][:, -1]
    turn = rates @ axis
    middle = slice(len(turn) // 4, max(len(turn) // 4 + 1, 3 * len(turn) // 4))
    sign = 1.0 if turn[middle].sum() >= 0.0 else -1.0
    return epochs[middle.start + int(np.argmax(sign * turn[middle]))]
