"""The joint estimate of both feet as a constraint method sees it: read, and update."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .kernel import Engine
from .kernel import layout as lay
from .kernel.turn import keeps_gauge
from .results.payloads import NO_DETAILS, Payload, named_values
from .samples.series import FloatArray

if TYPE_CHECKING:
    from .kernel.workspace import Workspace

Row = Mapping[int, float]


class HeadingCorrection(StrEnum):
    """What an update may correct of the headings and the gyro biases of the feet.

    Attributes
    ----------
    FULL : all that the Kalman gain says, as in the papers
    DIFFERENCE : the difference of the headings; what they have in common and the gyro biases are
        taken as known, and their uncertainty is carried
    NONE : nothing; all of them are taken as known, and their uncertainty is carried
    BIAS : the gyro biases, but neither headings nor positions
    """

    FULL = "full"
    DIFFERENCE = "difference"
    NONE = "none"
    BIAS = "bias"


LEFT_ALONE: Mapping[str, int] = {
    HeadingCorrection.FULL: lay.KNOW_NOTHING,
    HeadingCorrection.DIFFERENCE: lay.KNOW_COMMON,
    HeadingCorrection.NONE: lay.KNOW_ALL,
    HeadingCorrection.BIAS: lay.KEEP_PLACE,
}


class Outcome(NamedTuple):
    """What came of a constraint: as in :class:`dualfoot_ros.core.Event`."""

    innovation: FloatArray
    S: FloatArray
    nis: float
    accepted: bool = True
    payload: Payload = NO_DETAILS
    reason: StrEnum | None = None

    @property
    def detail(self) -> dict[str, Any]:
        """Further values by name, for files and people: those of the payload, and the reason."""
        return named_values(self.payload, self.reason)


def nothing_done(payload: Payload, reason: StrEnum, size: int = 0) -> Outcome:
    """Return the outcome of a constraint that was not applied, its innovation (size,) zero."""
    nis = 0.0 if size else math.nan
    return Outcome(np.zeros(size), np.zeros((size, size)), nis, False, payload, reason)


class Touchdown(NamedTuple):
    """The velocity (3,) m/s of a foot when its stance began, and its NIS, that of `landing`."""

    nis: float
    velocity: list[float]


class JointEstimate:
    """Both feet's states with their joint covariance.

    Error states are numbered as in eq. (9) of Liu et al. 2023: 0..14 the left foot's, 15..29 the
    right foot's; within a foot position, velocity, attitude, gyro bias, accelerometer bias.
    """

    def __init__(self, workspace: Workspace, engine: Engine) -> None:
        """Look at the present state of ``workspace``."""
        self._space, self._engine = workspace, engine
        self._x = np.zeros(lay.X_SIZE)
        # what an update was given and its S: the innovation, the noise, then S
        self._measured = self._x[lay.X_Y : lay.X_BEFORE].reshape(2 + lay.ROWS_MOST, lay.ROWS_MOST)

    def position(self, foot: int) -> FloatArray:
        """Return the position (3,) m of foot 0 (left) or 1 (right)."""
        start = foot * lay.FOOT + lay.POS
        return self._space.w[start : start + 3].copy()

    def velocity(self, foot: int) -> FloatArray:
        """Return the velocity (3,) m/s of foot 0 or 1."""
        start = foot * lay.FOOT + lay.VEL
        return self._space.w[start : start + 3].copy()

    def gyro_bias(self, foot: int) -> FloatArray:
        """Return the gyro bias (3,) rad/s of foot 0 or 1."""
        start = foot * lay.FOOT + lay.BG
        return self._space.w[start : start + 3].copy()

    @property
    def keeps_gauge(self) -> bool:
        """Whether updates must leave what a turn of a whole track is."""
        return any(keeps_gauge(self._space.w, foot) for foot in range(2))

    def keep_gyro_bias_std(self, foot: int, least: float) -> None:
        """Let no gyro bias of foot 0 or 1 be known better than to ``least`` rad/s.

        What the model leaves out (scale factor, misalignment) acts like a bias while walking and
        is not learnt while standing.
        """
        rows = self._space.own_block(foot)
        for i in range(lay.E_BG, lay.E_BG + 3):
            rows[i, i] = max(rows[i, i], least**2)

    def place(self, foot: int, position: FloatArray) -> None:
        """Put foot 0 or 1 at ``position`` (3,) m; nothing else changes."""
        start = foot * lay.FOOT + lay.POS
        self._space.w[start : start + 3] = position

    def covariance(self) -> FloatArray:
        """Return the covariance (30, 30) of the error states."""
        return self._space.covariance()

    def rotation(self, foot: int) -> FloatArray:
        """Return R_nb (3, 3) of foot 0 or 1."""
        start = foot * lay.FOOT + lay.ROT
        return self._space.w[start : start + 9].reshape(3, 3).copy()

    def relative_position(self) -> list[float]:
        """Return left minus right position, m."""
        w, right = self._space.w, lay.FOOT + lay.POS
        pairs = zip(w[lay.POS : lay.POS + 3].tolist(), w[right : right + 3].tolist(), strict=True)
        return [x - y for x, y in pairs]

    def relative_covariance(self) -> list[list[float]]:
        """Return the covariance (3, 3) m^2 of left minus right position."""
        left, right, cross = (self._corner(block) for block in (lay.PLL, lay.PRR, lay.PLR))
        return [
            [left[i][j] + right[i][j] - cross[i][j] - cross[j][i] for j in range(3)]
            for i in range(3)
        ]

    def _corner(self, block: int) -> list[list[float]]:
        """Return the positions' part (3, 3) m^2 of a covariance block."""
        w = self._space.w
        return [
            w[start : start + 3].tolist() for start in range(block, block + 3 * lay.ROW, lay.ROW)
        ]

    def closest(
        self, r: Sequence[float], p: Sequence[Sequence[float]], c0: float, std: float
    ) -> tuple[list[float], float, float]:
        """Return (direction, innovation, noise) that move the state to the least cost of eq. (14).

        ``r`` (3,) m with |r| > c0 is the estimated separation, ``p`` (3, 3) m^2 its covariance.  A
        hard c0 that the uncertain directions cannot reach gives a zero row: nothing is done.
        """
        x = np.empty(lay.X_SIZE)
        x[lay.M_R : lay.M_AXES] = [*r, *p[0], *p[1], *p[2]]
        self._engine.closest(x, c0, std)
        direction: list[float] = x[lay.M_DIRECTION : lay.M_PUSH].tolist()
        return direction, float(x[lay.M_PUSH]), float(x[lay.M_NOISE])

    def variance(self, rows: Sequence[Row]) -> FloatArray:
        """Return H P H' (m, m) of up to three rows, each {error state: coefficient}."""
        self._put(rows)
        m = len(rows)
        self._engine.collect(self._space.w, m)
        return self._space.w[lay.S_S : lay.S_S + 9].reshape(3, 3)[:m, :m].copy()

    def update(
        self,
        rows: Sequence[Row],
        innovation: Sequence[float],
        variances: Sequence[float],
        heading: HeadingCorrection = HeadingCorrection.FULL,
    ) -> tuple[FloatArray, float]:
        """Update with up to three scalar measurements; return (S, NIS).

        ``innovation`` is predicted minus measured (estimate minus truth, as the errors are) and
        ``variances`` the noise of each; zero makes an exact constraint.  A variance H P H' that is
        mere rounding counts as none: what an exact constraint has settled stays settled.
        ``heading`` is what the update may correct of headings and gyro biases.
        """
        m = len(rows)
        self._put(rows)
        x = self._x
        x[lay.X_Y : lay.X_Y + m] = innovation
        x[lay.X_NOISE : lay.X_NOISE + m] = variances
        nis = self._engine.observe(self._space.w, x, m, LEFT_ALONE[heading])
        return self.measured(m)[1], float(nis)

    def act(self, entry: str, *given: float) -> tuple[float, list[float]]:
        """Run an ``entry`` of the kernel that acts at a stance, with what it is ``given``.

        Returns what the entry returns, and the array (X_SIZE,) in which it has left more.
        """
        result = getattr(self._engine, entry)(self._space.w, self._x, *given)
        return float(result), self._x.tolist()

    def end_stance(
        self,
        rule: FloatArray,
        learnt: FloatArray,
        foot: int,
        heading: float,
        gate: float,
        since: int,
    ) -> tuple[int, list[float]]:
        """Do what a ``rule`` says at the end of the stance of ``foot``, in the kernel.

        Returns what was done, END_DONE or another, and what is told of that (X_TOLD,).
        """
        w, n, x = self._space.w, self._space.n, self._x
        ahead = math.cos(heading), math.sin(heading)
        done = self._engine.end_stance(w, n, x, rule, learnt, foot, *ahead, gate, since)
        return done, x[: lay.X_TOLD].tolist() if done == lay.END_DONE else []

    def measured(self, rows: int) -> tuple[FloatArray, FloatArray]:
        """Return innovation (m,) and S (m, m) of the ``rows`` that `act` has updated with."""
        kept = self._measured.copy()
        return kept[0, :rows], kept[2 : 2 + rows, :rows]

    def landing(self, foot: int, std: float) -> float:
        """Return the NIS of the velocity with which foot 0 or 1 came to its present stance.

        A landing has a velocity of ``std`` m/s beside what the state says.  The NIS is -1 where
        the stance has begun before all that is remembered.
        """
        nis: float = self._engine.landing(self._space.w, self._space.n, self._x, foot, std)
        return nis

    def touchdown(self, foot: int, std: float) -> Touchdown:
        """Return how foot 0 or 1 came to its present stance, as `landing` does."""
        nis = self.landing(foot, std)
        return Touchdown(nis, self._x[lay.X_VELOCITY : lay.X_VELOCITY + 3].tolist())

    def update_with(self, cross: FloatArray, innovation: float, s: float) -> float:
        """Update with one measurement whose statistics are known; return the NIS.

        ``cross`` (30,) is the covariance of the error state with the predicted measurement error,
        ``s`` the innovation variance; ``innovation`` is predicted minus measured.
        """
        w = self._space.w
        right = lay.S_G + lay.SIDE
        w[lay.S_G : lay.S_G + lay.JOINT] = 0.0
        w[lay.S_G : lay.S_G + lay.ERRORS] = cross[: lay.ERRORS]
        w[right : right + lay.ERRORS] = cross[lay.ERRORS :]
        w[lay.S_S], w[lay.S_Y] = s, innovation
        return float(self._engine.correct(w, 1))

    def _put(self, rows: Sequence[Row]) -> None:
        """Write the measurement matrix."""
        w = self._space.w
        w[lay.S_H : lay.S_H + lay.ROWS_MOST * lay.JOINT] = 0.0
        for k, row in enumerate(rows):
            for state, coefficient in row.items():
                pad = lay.SIDE - lay.ERRORS if state >= lay.ERRORS else 0
                w[lay.S_H + lay.JOINT * k + state + pad] = coefficient


def relative_row(direction: Sequence[float]) -> dict[int, float]:
    """Return the row that measures left minus right position along ``direction`` (3,)."""
    row = {lay.position_row(0, i): float(direction[i]) for i in range(3)}
    row.update({lay.position_row(1, i): -float(direction[i]) for i in range(3)})
    return row
