"""One run of the filter of :mod:`.matrix_filter` over a walk.

A sample of a stance is an update.  A swing is none, so that all its samples are one transition in
closed form: the attitude error grows by sums of C dt and C W dt, the velocity error by the sum of
the pushes times the attitude error before each of them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core import FloatArray, exact_rotation, skew, stance_bounds
from .filter_terms import FilterNoise, increments, rate_columns, rotations, symmetric
from .foot_walk import NO_GAP_S, FootWalk

PHI, VEL, BG, BA = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)
M, LEVER = slice(12, 18), slice(18, 20)
SEEN = slice(12, 20)  # what a walk tells about: m and the pivot
STATES = 20
IDENTITY = np.eye(3)
ALIKE_S = 0.5  # over which the errors of a standing foot are alike
OUTLIER = 4.0  # NIS per degree of freedom of a stance's first sample that is none


class FilterPass:
    """One run of the filter over ``walk``, linearised at ``point`` (8,)."""

    def __init__(self, walk: FootWalk, point: FloatArray, noise: FilterNoise) -> None:
        self._walk, self._noise = walk, noise
        self._rate = walk.rate @ (np.eye(3) + symmetric(point[:6])).T
        self._bridged = walk.interval_s > NO_GAP_S
        self._dt = np.where(self._bridged, np.median(walk.interval_s), walk.interval_s)
        turns, self._push = increments(walk.force, self._rate, self._dt, walk.increments)
        self._turn = rotations(turns)
        self._columns = rate_columns(self._rate)
        self._turned = self._columns * self._dt[:, None, None]
        self._pivot_axes = -np.stack([walk.up, walk.forward], axis=1)
        self._point = point
        self._samples = np.ones(len(walk))
        longest = max(1, round(ALIKE_S / float(np.median(self._dt))))
        for first, end in stance_bounds(walk.stance):
            self._samples[first:end] = min(end - first, longest)
        self._seconds: list[float] = self._dt.tolist()
        self._added = np.repeat([noise.gyro**2, noise.accelerometer**2], 3)
        self._transition = np.eye(STATES)  # each step writes the same blocks of it
        self._row = np.zeros((3, STATES))  # and each sample of a stance the same of this one
        self._row[:, VEL] = IDENTITY
        self._r, self._v = walk.attitude.copy(), np.zeros(3)
        self._x, self._p = np.zeros(STATES), noise.start(walk.bias_std)
        self._in_stance = self._left_out = False
        self._nis: list[float] = []

    @property
    def misfit(self) -> float:
        """Mean NIS of the stances, per degree of freedom."""
        return float(np.mean(self._nis)) if self._nis else 1.0

    def run(self) -> tuple[FloatArray, FloatArray]:
        """Return the covariance (8, 8) and the change (8,) of matrix and pivot."""
        for first, end in self._steps():
            if end - first > 1:
                self._swing(slice(first, end))
            else:
                self._propagate(first)
            if self._bridged[end - 1]:
                self._p[VEL, VEL] += IDENTITY
                self._p[PHI, PHI] += 0.01 * IDENTITY
            if self._walk.stance[end - 1]:
                self._stand(end - 1)
            else:
                self._in_stance = False
        return self._p[SEEN, SEEN], self._x[SEEN]

    def _steps(self) -> Iterator[tuple[int, int]]:
        """Yield first and end of each step: all samples up to an update or a gap, inclusive."""
        ends = np.flatnonzero(self._walk.stance | self._bridged) + 1
        ends = np.unique(np.append(ends, len(self._walk)))
        yield from zip([0, *ends[:-1].tolist()], ends.tolist(), strict=True)

    def _propagate(self, k: int) -> None:
        """Go on by one sample."""
        dt, r, x = self._seconds[k], self._r, self._x
        turned, pushed = self._turned[k], r * dt
        push = r @ (self._push[k] - x[BA] * dt)
        f = self._transition
        f[VEL, PHI] = skew(push)
        f[VEL, BA] = pushed
        f[PHI, BG] = -pushed
        f[PHI, M] = r @ turned
        f[VEL, BG] = f[VEL, M] = 0.0
        self._v += push
        self._v[2] -= self._walk.gravity * dt
        more = turned @ x[M] - x[BG] * dt
        self._r = r @ self._turn[k] @ (IDENTITY + skew(more))
        self._p = f @ self._p @ f.T
        self._p.reshape(-1)[: 6 * (STATES + 1) : STATES + 1] += dt * self._added  # P_ii of six

    def _swing(self, step: slice) -> None:
        """Go on by the samples of ``step``, none but the last of which is an update."""
        x, dt = self._x, self._dt[step]
        turned = self._turned[step]
        r = self._attitudes(step, turned @ x[M] - np.outer(dt, x[BG]))
        along, columns = r * dt[:, None, None], r @ turned
        pushes = (r @ (self._push[step] - np.outer(dt, x[BA]))[:, :, None])[:, :, 0]
        self._v += pushes.sum(axis=0)
        self._v[2] -= self._walk.gravity * dt.sum()
        f = self._transition
        f[VEL, PHI] = skew(pushes.sum(axis=0))
        f[VEL, BA] = along.sum(axis=0)
        f[PHI, BG] = -f[VEL, BA]
        f[PHI, M] = columns.sum(axis=0)
        behind = _sum_behind(pushes)
        f[VEL, BG] = -np.cross(behind[:, None], along.transpose(0, 2, 1)).sum(axis=0).T
        f[VEL, M] = np.cross(behind[:, None], columns.transpose(0, 2, 1)).sum(axis=0).T
        self._p = f @ self._p @ f.T
        self._add_noise(dt, behind)

    def _attitudes(self, step: slice, more: FloatArray) -> FloatArray:
        """Return the attitudes (N, 3, 3) before each sample, with ``more`` (N, 3) turn in each."""
        turns = self._turn[step]
        turns = turns + np.cross(turns, more[:, None])  # T (I + [more x]), row by row
        before = np.empty_like(turns)
        for k in range(len(turns)):
            before[k] = self._r
            self._r = self._r @ turns[k]
        return before

    def _add_noise(self, dt: FloatArray, behind: FloatArray) -> None:
        """Add the noise of samples, which ``behind`` (N, 3) pushed on: the pushes after each."""
        gyro = self._noise.gyro**2
        self._p[PHI, PHI] += gyro * dt.sum() * IDENTITY
        across = skew(gyro * dt @ behind)
        self._p[VEL, PHI] += across
        self._p[PHI, VEL] += across.T
        weighted = gyro * dt[:, None] * behind
        spread = weighted.T @ behind
        along = np.trace(spread) + self._noise.accelerometer**2 * dt.sum()
        self._p[VEL, VEL] += along * IDENTITY - spread

    def _stand(self, k: int) -> None:
        """Update with a sample of a stance: the pivot of the foot does not move.

        With w = P C w the level rate and a the arm, both in navigation axes, the row has
        [w x][a x] - [a x] P [C w x] for the attitude.
        """
        r, x = self._r, self._x
        turn = r @ (self._rate[k] + self._columns[k] @ x[M] - x[BG])
        wx, wy, wz = turn.tolist()
        arm = r @ (self._pivot_axes @ (self._point[6:] + x[LEVER]))
        ax, ay, az = arm.tolist()
        level_x = np.array([[0.0, 0.0, wy], [0.0, 0.0, -wx], [-wy, wx, 0.0]])
        on_arm = np.array([[0.0, -az, 0.0], [az, 0.0, 0.0], [-ay, ax, 0.0]]) @ r
        h = self._row
        h[:, PHI] = (
            (az * wz - wy * ay, wy * ax, -az * wx),
            (wx * ay, az * wz - wx * ax, -az * wy),
            (wx * az - ax * wz, wy * az - ay * wz, 0.0),
        )
        h[:, BG] = -on_arm
        h[:, M] = on_arm @ self._columns[k]
        h[:, LEVER] = -level_x @ r @ self._pivot_axes
        rate_squared = wx * wx + wy * wy + wz * wz
        variance = self._noise.velocity**2 + self._noise.velocity_per_rate**2 * rate_squared
        self._update(h, self._v + level_x @ arm, variance, self._samples[k])

    def _update(
        self, h: FloatArray, innovation: FloatArray, variance: float, samples: float
    ) -> None:
        """Update, unless the stance is none; two in a row are never left out."""
        cross = self._p @ h.T
        spread = h @ cross
        if not self._in_stance:
            nis = float(innovation @ inverse(spread + variance * IDENTITY) @ innovation)
            self._in_stance = True
            self._left_out = nis > OUTLIER * len(innovation) and not self._left_out
            if not self._left_out:
                self._nis.append(nis / len(innovation))
        if self._left_out:
            return
        gain = cross @ inverse(spread + variance * samples * IDENTITY)
        p = self._p - gain @ cross.T
        self._p = 0.5 * (p + p.T)
        change = gain @ innovation
        self._v -= change[VEL]
        self._r = exact_rotation(change[PHI]) @ self._r
        self._x[6:] += change[6:]


def inverse(symmetric_matrix: FloatArray) -> FloatArray:
    """Return the inverse of a symmetric matrix (3, 3), by its minors."""
    (a, b, c), (_, d, e), (_, _, f) = symmetric_matrix.tolist()
    u, v, w = d * f - e * e, c * e - b * f, b * e - c * d
    x, y, z = a * f - c * c, b * c - a * e, a * d - b * b
    minors = np.array([[u, v, w], [v, x, y], [w, y, z]], dtype=np.float64)
    found: FloatArray = minors / (a * u + b * v + c * w)
    return found


def _sum_behind(vectors: FloatArray) -> FloatArray:
    """Return the sums (N, 3) of the vectors (N, 3) after each."""
    behind: FloatArray = vectors.sum(axis=0) - np.cumsum(vectors, axis=0)
    return behind
