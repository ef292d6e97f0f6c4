"""What the filter of a walk is made of: noise, columns of the matrix, rotations, increments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray, Increments

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
