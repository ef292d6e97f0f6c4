"""One foot on one walk through an error-state filter that also estimates the gyro matrix.

States: attitude error phi (navigation axes, C_hat = (I - [phi x]) C), velocity error, gyro bias,
accelerometer bias, the six elements m = (xx, yy, zz, xy, xz, yz) of the symmetric matrix S, and
height and set-back (h, b) of the sensor over the pivot of the foot.  With w the measured rate less
the bias of the stand, the true one is w + S(m) w - bias, and S(m) w = W(w) m.

- d phi = C (W(w) m - bias) dt: with the signs of the filter, phi grows by C W(w) dm dt when the
  estimate of m lacks dm.
- A standing foot turns about its pivot: 0 = v + (P C w) x C l with P = diag(1, 1, 0), as in the
  tracker, so its row has blocks for phi, bias, m and l.

The noise is that of a stance, not of a sample: the errors within a stance are alike, so a sample's
variance is multiplied by the number of samples of its stance.  There is no position: nothing here
needs to know where the walk led.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, Increments, exact_rotation, skew, stance_bounds
from .foot_walk import NO_GAP_S, FootWalk

ELEMENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
PHI, VEL, BG, BA = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)
M, LEVER = slice(12, 18), slice(18, 20)
SEEN = slice(12, 20)  # what a walk tells about: m and the pivot
STATES = 20
LEVEL = np.diag([1.0, 1.0, 0.0])
IDENTITY = np.eye(3)
ALIKE_S = 0.5  # over which the errors of a standing foot are alike
OUTLIER = 4.0  # NIS per degree of freedom of a stance's first sample that is none
SMALL = 1e-12  # rad^2, of a rotation whose series is exact


@dataclass(frozen=True)
class FilterNoise:
    """Noise of the fit: of a stance's velocity, of the sensors, and at the start.

    Attributes
    ----------
    velocity : m/s, of a stance
    velocity_per_rate : m/s per rad/s, added to it
    gyro, accelerometer : rad/s/sqrt(Hz), m/s^2/sqrt(Hz); far above the white noise
    gyro_bias : rad/s, error of the stand's bias, at least
    accelerometer_bias : m/s^2
    tilt : rad
    matrix : prior of an element of the matrix
    pivot : m, prior of height and set-back of the sensor
    """

    velocity: float = 0.02
    velocity_per_rate: float = 0.05
    gyro: float = 1.0e-3
    accelerometer: float = 5.0e-3
    gyro_bias: float = 8.7e-4
    accelerometer_bias: float = 0.1
    tilt: float = 0.01
    matrix: float = 0.005
    pivot: float = 0.03

    def prior(self) -> FloatArray:
        """Return the variances (8,) of the matrix and the pivot before any walk."""
        return np.array([self.matrix**2] * 6 + [max(self.pivot, 1e-9) ** 2] * 2)

    def start(self, bias_std: float) -> FloatArray:
        """Return P0 (20, 20); ``bias_std`` is the deviation of the stand's bias, rad/s."""
        bias = max(self.gyro_bias, bias_std)
        stds = [self.tilt, self.tilt, 1e-5, *[0.01] * 3]
        stds += [*[bias] * 3, *[self.accelerometer_bias] * 3]
        return np.diag([*np.square(stds), *self.prior()])


@dataclass(frozen=True)
class Information:
    """What one walk tells about m and the pivot, without the prior: J (x - x_hat) = 0.

    Attributes
    ----------
    matrix : J (8, 8)
    vector : J x_hat (8,), relative to the point of linearisation
    misfit : mean NIS of the stances, per degree of freedom, at least 1; J is divided by it
    """

    matrix: FloatArray
    vector: FloatArray
    misfit: float = 1.0


def filter_walk(walk: FootWalk, point: FloatArray, noise: FilterNoise) -> Information:
    """Return what ``walk`` tells about matrix and pivot, linearised at ``point`` (8,)."""
    run = _Pass(walk, point, noise)
    covariance, change = run.run()
    whole = np.asarray(np.linalg.inv(covariance), dtype=np.float64)
    # noise.prior() enters at `point`, so the mean of the prior is a change of zero
    told: FloatArray = whole - np.diag(1.0 / noise.prior())
    misfit = max(1.0, run.misfit)
    return Information(told / misfit, whole @ change / misfit, misfit)


def symmetric(elements: FloatArray) -> FloatArray:
    """Return S(m) (3, 3) of the six elements (6,)."""
    xx, yy, zz, xy, xz, yz = elements
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def rate_columns(rate: FloatArray) -> FloatArray:
    """Return W (N, 3, 6) of angular rates (N, 3), so that W m = S(m) w."""
    x, y, z = rate.T
    columns = np.zeros((len(rate), 3, 6))
    columns[:, 0, 0], columns[:, 0, 3], columns[:, 0, 4] = x, y, z
    columns[:, 1, 1], columns[:, 1, 3], columns[:, 1, 5] = y, x, z
    columns[:, 2, 2], columns[:, 2, 4], columns[:, 2, 5] = z, x, y
    return columns


def rotations(vectors: FloatArray) -> FloatArray:
    """Return the rotation matrices (N, 3, 3) of rotation vectors (N, 3) rad."""
    square = (vectors**2).sum(axis=1)
    angle = np.sqrt(square)
    small = square < SMALL
    safe = np.where(small, 1.0, angle)
    a = np.where(small, 1.0 - square / 6.0, np.sin(angle) / safe)
    b = np.where(small, 0.5 - square / 24.0, (1.0 - np.cos(angle)) / np.where(small, 1.0, square))
    k = np.zeros((len(vectors), 3, 3))
    x, y, z = vectors.T
    k[:, 0, 1], k[:, 0, 2], k[:, 1, 2] = -z, y, -x
    k -= k.transpose(0, 2, 1)
    found: FloatArray = np.eye(3) + a[:, None, None] * k + b[:, None, None] * (k @ k)
    return found


def increments(
    force: FloatArray, rate: FloatArray, interval: FloatArray, kind: Increments
) -> tuple[FloatArray, FloatArray]:
    """Return rotation vectors (N, 3) rad and velocity increments (N, 3) m/s in body axes.

    As the tracker's mechanization: no term across samples where the sensor has compensated coning
    and sculling, the two-sample terms otherwise.
    """
    dt = interval[:, None]
    if kind is Increments.SAMPLED:
        force = 0.5 * (force + np.vstack([force[:1], force[:-1]]))
        rate = 0.5 * (rate + np.vstack([rate[:1], rate[:-1]]))
    alpha, gamma = rate * dt, force * dt
    velocity = gamma + 0.5 * np.cross(alpha, gamma)
    if kind is Increments.COMPENSATED:
        return alpha, velocity + np.cross(alpha, np.cross(alpha, gamma)) / 6.0
    before, force_before = np.zeros_like(alpha), np.zeros_like(gamma)
    before[1:], force_before[1:] = alpha[:-1], gamma[:-1]
    velocity += (np.cross(before, gamma) + np.cross(force_before, alpha)) / 12.0
    return alpha + np.cross(before, alpha) / 12.0, velocity


class _Pass:
    """One run of the filter over a walk."""

    def __init__(self, walk: FootWalk, point: FloatArray, noise: FilterNoise) -> None:
        self._walk, self._noise = walk, noise
        self._rate = walk.rate @ (np.eye(3) + symmetric(point[:6])).T
        self._dt = np.where(
            walk.interval_s > NO_GAP_S, np.median(walk.interval_s), walk.interval_s
        )
        turns, self._push = increments(walk.force, self._rate, self._dt, walk.increments)
        self._turn = rotations(turns)
        self._columns = rate_columns(self._rate)
        self._turned = self._columns * self._dt[:, None, None]
        self._seconds: list[float] = self._dt.tolist()
        self._pivot_axes = -np.stack([walk.up, walk.forward], axis=1)
        self._point = point
        self._samples = np.ones(len(walk))
        longest = max(1, round(ALIKE_S / float(np.median(self._dt))))
        for first, end in stance_bounds(walk.stance):
            self._samples[first:end] = min(end - first, longest)
        self._transition = np.eye(STATES)  # each sample writes the same blocks of it
        self._row = np.zeros((3, STATES))  # and each sample of a stance the same of this one
        self._row[:, VEL] = IDENTITY
        self._added = np.repeat([noise.gyro**2, noise.accelerometer**2], 3)
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
        bridged = self._walk.interval_s > NO_GAP_S
        for k in range(len(self._walk)):
            self._propagate(k)
            if bridged[k]:
                self._p[VEL, VEL] += IDENTITY
                self._p[PHI, PHI] += 0.01 * IDENTITY
            if self._walk.stance[k]:
                self._stand(k)
            else:
                self._in_stance = False
        return self._p[SEEN, SEEN], self._x[SEEN]

    def _propagate(self, k: int) -> None:
        dt, r, x = self._seconds[k], self._r, self._x
        turned, pushed = self._turned[k], r * dt
        push = r @ (self._push[k] - x[BA] * dt)
        f = self._transition
        f[VEL, PHI] = skew(push)
        f[VEL, BA] = pushed
        f[PHI, BG] = -pushed
        f[PHI, M] = r @ turned
        self._v += push
        self._v[2] -= self._walk.gravity * dt
        more = turned @ x[M] - x[BG] * dt
        self._r = r @ self._turn[k] @ (IDENTITY + skew(more))
        self._p = f @ self._p @ f.T
        self._p.reshape(-1)[: 6 * (STATES + 1) : STATES + 1] += dt * self._added  # P_ii of six

    def _stand(self, k: int) -> None:
        """Update with a sample of a stance: the pivot of the foot does not move."""
        r, x = self._r, self._x
        turn = r @ (self._rate[k] + self._columns[k] @ x[M] - x[BG])
        level = LEVEL @ turn
        arm = r @ (self._pivot_axes @ (self._point[6:] + x[LEVER]))
        level_x, arm_x = skew(level), skew(arm)
        on_arm = arm_x @ LEVEL
        h = self._row
        h[:, PHI] = level_x @ arm_x - on_arm @ skew(turn)
        h[:, BG] = -on_arm @ r
        h[:, M] = on_arm @ r @ self._columns[k]
        h[:, LEVER] = -level_x @ r @ self._pivot_axes
        variance = self._noise.velocity**2 + self._noise.velocity_per_rate**2 * (turn @ turn)
        self._update(h, self._v + level_x @ arm, variance, self._samples[k])

    def _update(
        self, h: FloatArray, innovation: FloatArray, variance: float, samples: float
    ) -> None:
        """Update, unless the stance is none; two in a row are never left out."""
        cross = self._p @ h.T
        if not self._in_stance:
            spread = h @ cross + variance * IDENTITY
            nis = float(innovation @ np.linalg.solve(spread, innovation))
            self._in_stance = True
            self._left_out = nis > OUTLIER * len(innovation) and not self._left_out
            if not self._left_out:
                self._nis.append(nis / len(innovation))
        if self._left_out:
            return
        gain = np.linalg.solve(h @ cross + variance * samples * IDENTITY, cross.T).T
        p = self._p - gain @ cross.T
        self._p = 0.5 * (p + p.T)
        change = gain @ innovation
        self._v -= change[VEL]
        self._r = exact_rotation(change[PHI]) @ self._r
        self._x[6:] += change[6:]
