"""The strapdown mechanization of Liu et al. 2023, eqs (1)-(3), over many starts at once."""

import numpy as np
from scipy.spatial.transform import Rotation

GRAVITY = 9.80665


def strides(series, truth, bounds):
    """Integrate each (first, last) of ``bounds`` from the truth; return (M, 3) position errors.

    The error is that at the last sample of each stretch.
    """
    dt = float(np.median(np.diff(series.stamp_ns))) * 1e-9
    first, last = np.array(bounds).T
    alpha, gamma = series.angular_rate * dt, series.specific_force * dt
    position, velocity = truth.position[first], truth.velocity[first]
    attitude = Rotation.from_quat(truth.quaternion[first])
    error = np.zeros_like(position)
    for step in range(1, int((last - first).max()) + 1):
        k = np.minimum(first + step, len(series) - 1)
        rho = alpha[k] + np.cross(alpha[k - 1], alpha[k]) / 12.0
        cross = np.cross(alpha[k - 1], gamma[k]) + np.cross(gamma[k - 1], alpha[k])
        v_sf = gamma[k] + 0.5 * np.cross(alpha[k], gamma[k]) + cross / 12.0
        after = velocity + attitude.apply(v_sf) - [0.0, 0.0, GRAVITY * dt]
        position = position + 0.5 * (velocity + after) * dt
        velocity, attitude = after, attitude * Rotation.from_rotvec(rho)
        done = last - first == step
        error[done] = (position - truth.position[k])[done]
    return error
