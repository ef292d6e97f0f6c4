"""Random states of a workspace, and the errors of a nominal state, for the tests of the kernel."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import layout as at
from dualfoot_ros.core.kernel.workspace import Workspace

SCALES = np.repeat([0.3, 0.1, 0.02, 1e-3, 0.05], 3)
SAMPLE = at.RINGS + 1


def random_workspace(seed: int, config: TrackerConfig | None = None) -> Workspace:
    """Return a workspace with moving feet, a full random covariance, and one sample for each."""
    rng = np.random.default_rng(seed)
    space = Workspace(config or TrackerConfig(method="zupt"), 100.0, 0.1)
    w = space.w
    for foot in range(2):
        o = foot * at.FOOT
        w[o : o + at.FOOT] = rng.normal(size=at.FOOT)
        w[o + at.ROT : o + at.ROT + 9] = Rotation.random(random_state=rng).as_matrix().ravel()
        w[o + at.BG : o + at.BA + 3] *= 0.02
        w[o + at.ALPHA : o + at.GAMMA + 3] *= 0.02
        lever = at.C_FOOT + foot * at.C_STRIDE + at.C_LEVER
        w[lever : lever + 3] = rng.normal(size=3) * 0.1
    w[SAMPLE : SAMPLE + 12] = rng.normal(size=12) * np.repeat([8.0, 3.0, 8.0, 3.0], 3)
    root = rng.normal(size=(30, 30)) * np.tile(SCALES, 2)[:, None]
    set_covariance(space, root @ root.T / 30.0)
    return space


def set_covariance(space: Workspace, P: np.ndarray) -> None:
    """Write a (30, 30) covariance into the three blocks."""
    P = np.triu(P) + np.triu(P, 1).T
    for start, part in ((at.PLL, P[:15, :15]), (at.PRR, P[15:, 15:]), (at.PLR, P[:15, 15:])):
        space.w[start : start + at.BLOCK].reshape(15, at.ROW)[:, :15] = part


def nominal(w: np.ndarray, foot: int) -> tuple[np.ndarray, ...]:
    """Return copies of (position, velocity, C, gyro bias, accelerometer bias)."""
    o = foot * at.FOOT
    r, v, bg, ba = (w[o + i : o + i + 3].copy() for i in (at.POS, at.VEL, at.BG, at.BA))
    return r, v, w[o + at.ROT : o + at.ROT + 9].reshape(3, 3).copy(), bg, ba


def put_error(w: np.ndarray, foot: int, error: np.ndarray) -> None:
    """Give the true state in ``w`` an error (15,), as the paper's signs have it."""
    o = foot * at.FOOT
    w[o + at.POS : o + at.POS + 3] += error[0:3]
    w[o + at.VEL : o + at.VEL + 3] += error[3:6]
    C = w[o + at.ROT : o + at.ROT + 9].reshape(3, 3)
    C[:] = Rotation.from_rotvec(-error[6:9]).as_matrix() @ C
    w[o + at.BG : o + at.BG + 3] -= error[9:12]
    w[o + at.BA : o + at.BA + 3] -= error[12:15]


def error_between(estimate, truth) -> np.ndarray:
    """Return the error state (15,) of two nominal states."""
    phi = -Rotation.from_matrix(estimate[2] @ truth[2].T).as_rotvec()
    return np.concatenate(
        [
            estimate[0] - truth[0],
            estimate[1] - truth[1],
            phi,
            truth[3] - estimate[3],
            truth[4] - estimate[4],
        ]
    )
