"""What a set of walks tells poorly about the gyro matrix, and what walk would tell it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .foot_walk import FootWalk
from .gyro_matrix import GyroMatrixFit
from .matrix_filter import ELEMENTS

WELL_KNOWN = 0.4  # of the prior; a direction known no better is called poorly observed
NAMED = 0.3  # share of a direction that an element must have to be named
LEAST_TURN_RAD = 2.0 * np.pi  # to either side
LEAST_S = 50.0
BAD_FIT = 1.5  # misfit of a walk that the model does not describe
BALANCE = 0.25  # share of all turns that must go to either side
ADVICE = (
    "walk a figure of eight, both ways round, with tight turns, for one to two minutes, after "
    "standing still for some seconds"
)


@dataclass(frozen=True)
class Direction:
    """A combination of elements (6,) of length 1, and its standard deviation."""

    elements: FloatArray
    std: float

    def __str__(self) -> str:
        """Return the combination in words, as in ``xx + zz``."""
        largest = np.abs(self.elements).max()
        named = [k for k in range(6) if abs(self.elements[k]) > NAMED * largest]
        sign = np.sign(self.elements[named[0]])
        terms = [
            f"{'+' if sign * self.elements[k] > 0 else '-'} "
            f"{abs(self.elements[k]) / largest:.1f} {ELEMENTS[k]}"
            for k in named
        ]
        return " ".join(terms).removeprefix("+ ")


def weakest(fit: GyroMatrixFit) -> Direction:
    """Return the direction about which the walks told least."""
    values, vectors = np.linalg.eigh(fit.covariance[:6, :6])
    return Direction(vectors[:, -1], float(np.sqrt(values[-1])))


@dataclass(frozen=True)
class Turns:
    """How far the walks of a foot turned to the left and to the right, rad, in ``seconds`` s."""

    left: float
    right: float
    seconds: float

    @property
    def left_deg(self) -> float:
        """Turns to the left in degrees."""
        return math.degrees(self.left)

    @property
    def right_deg(self) -> float:
        """Turns to the right in degrees."""
        return math.degrees(self.right)

    @property
    def enough(self) -> bool:
        """Whether both sides had turns, and long enough ones."""
        less = min(self.left, self.right)
        balanced = less >= BALANCE * (self.left + self.right)
        return less >= LEAST_TURN_RAD and balanced and self.seconds >= LEAST_S


def turns(walks: Sequence[FootWalk]) -> Turns:
    """Return the turns of the walks, from stance to stance."""
    steps = np.concatenate([walk.turns for walk in walks])
    seconds = sum(walk.duration_s for walk in walks)
    return Turns(float(steps[steps > 0].sum()), float(-steps[steps < 0].sum()), seconds)


def advice(fit: GyroMatrixFit, turned: Turns) -> Iterator[str]:
    """Yield sentences on what is poorly observed, and on the walk that would help."""
    weak = weakest(fit)
    if weak.std > WELL_KNOWN * fit.noise.matrix:
        yield (
            f"the combination {weak} is poorly observed: {100 * weak.std:.2f} % where nothing "
            f"is known to better than {100 * fit.noise.matrix:.2f} %"
        )
    worst = max(walk.misfit for walk in fit.walks)
    if worst > BAD_FIT:
        yield (
            f"a walk fits the model badly (misfit {worst:.1f}, 1 is due) and counts for less: the "
            "bias may have drifted on a long way, or stances be missing"
        )
    if not turned.enough:
        yield (
            f"the walks turn {turned.left_deg:.0f} degrees to the left and "
            f"{turned.right_deg:.0f} to the right within {turned.seconds:.0f} s; to "
            f"observe all elements, {ADVICE}"
        )
