"""Random states of a workspace, and the errors of a nominal state, for the tests of the kernel."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import Workspace
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.session.initial_state import InitialState

SCALES = np.repeat([0.3, 0.1, 0.02, 1e-3, 0.05], 3)
SAMPLE = lay.RINGS + 1


def configured(config: TrackerConfig, rate_hz: float, memory_s: float) -> Workspace:
    """Return a workspace with the constants of ``config``."""
    space = Workspace(rate_hz, memory_s)
    InitialState(config, space)
    return space


def random_workspace(seed: int, config: TrackerConfig | None = None) -> Workspace:
    """Return a workspace with moving feet, a full random covariance, and one sample for each."""
    rng = np.random.default_rng(seed)
    space = configured(config or TrackerConfig(method="zupt"), 100.0, 0.1)
    w = space.w
    for foot in range(2):
        o = foot * lay.FOOT
        w[o : o + lay.FOOT] = rng.normal(size=lay.FOOT)
        w[o + lay.ROT : o + lay.ROT + 9] = Rotation.random(random_state=rng).as_matrix().ravel()
        w[o + lay.BG : o + lay.BA + 3] *= 0.02
        w[o + lay.ALPHA : o + lay.GAMMA + 3] *= 0.02
        lever = lay.C_FOOT + foot * lay.C_STRIDE + lay.C_LEVER
        w[lever : lever + 3] = rng.normal(size=3) * 0.1
    w[SAMPLE : SAMPLE + 12] = rng.normal(size=12) * np.repeat([8.0, 3.0, 8.0, 3.0], 3)
    root = rng.normal(size=(30, 30)) * np.tile(SCALES, 2)[:, None]
    set_covariance(space, root @ root.T / 30.0)
    return space


def set_covariance(space: Workspace, P: np.ndarray) -> None:
    """Write a (30, 30) covariance into the three blocks."""
    P = np.triu(P) + np.triu(P, 1).T
    for start, part in ((lay.PLL, P[:15, :15]), (lay.PRR, P[15:, 15:]), (lay.PLR, P[:15, 15:])):
        space.w[start : start + lay.BLOCK].reshape(15, lay.ROW)[:, :15] = part


def nominal(w: np.ndarray, foot: int) -> tuple[np.ndarray, ...]:
    """Return copies of (position, velocity, C, gyro bias, accelerometer bias)."""
    o = foot * lay.FOOT
    r, v, bg, ba = (w[o + i : o + i + 3].copy() for i in (lay.POS, lay.VEL, lay.BG, lay.BA))
    return r, v, w[o + lay.ROT : o + lay.ROT + 9].reshape(3, 3).copy(), bg, ba


def put_error(w: np.ndarray, foot: int, error: np.ndarray) -> None:
    """Give the true state in ``w`` an error (15,), as the paper's signs have it."""
    o = foot * lay.FOOT
    w[o + lay.POS : o + lay.POS + 3] += error[0:3]
    w[o + lay.VEL : o + lay.VEL + 3] += error[3:6]
    C = w[o + lay.ROT : o + lay.ROT + 9].reshape(3, 3)
    C[:] = Rotation.from_rotvec(-error[6:9]).as_matrix() @ C
    w[o + lay.BG : o + lay.BG + 3] -= error[9:12]
    w[o + lay.BA : o + lay.BA + 3] -= error[12:15]


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
