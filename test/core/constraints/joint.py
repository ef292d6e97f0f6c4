"""Joint estimates with a chosen separation, and gaits made up of arrays, for tests of methods."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from dualfoot_ros.core.constraints.method import StancePhase
from dualfoot_ros.core.joint_estimate import JointEstimate
from dualfoot_ros.core.kernel import Workspace, interpreted
from dualfoot_ros.core.kernel import layout as lay

from ..dense import joseph
from ..kernel.states import error_between, nominal, random_workspace

SELECTOR = np.zeros((3, 30))
SELECTOR[:, 0:3], SELECTOR[:, 15:18] = np.eye(3), -np.eye(3)
POSITIONS = [0, 1, 2, 15, 16, 17]


def apart(seed: int, distance: float) -> tuple[Workspace, JointEstimate]:
    """Return a random joint state whose feet are ``distance`` m apart in a random direction."""
    space, rng = random_workspace(seed), np.random.default_rng(seed + 1)
    unit = rng.normal(size=3)
    set_separation(space, distance * unit / np.linalg.norm(unit))
    return space, JointEstimate(space, interpreted())


def set_separation(space: Workspace, r) -> None:
    """Place the right foot so that left minus right is ``r`` (3,) m."""
    left = space.w[lay.POS : lay.POS + 3]
    space.w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3] = left - np.asarray(r)


def separation(estimate: JointEstimate) -> np.ndarray:
    """Return left minus right position (3,), m."""
    return np.array(estimate.relative_position())


def states(space: Workspace) -> list[tuple[np.ndarray, ...]]:
    """Return copies of both feet's nominal states."""
    return [nominal(space.w, foot) for foot in range(2)]


def error_taken(before, space: Workspace) -> np.ndarray:
    """Return the error (30,) that was taken off the nominal states since ``before``."""
    return np.concatenate(
        [error_between(b, a) for b, a in zip(before, states(space), strict=True)]
    )


def assert_dense_update(before, P, space: Workspace, H, R, y) -> None:
    """Assert that the state in ``space`` is that of a dense Kalman update of (before, P)."""
    error, after, _, _ = joseph(P, np.atleast_2d(H), np.atleast_2d(R), np.atleast_1d(y))
    assert np.allclose(error_taken(before, space), error, rtol=1e-7, atol=1e-9)
    assert_same_covariance(space.covariance(), after, P)


def assert_same_covariance(found, expected, scale_of) -> None:
    """Assert equality against the size of the standard deviations of ``scale_of``."""
    stds = np.sqrt(np.diag(scale_of))
    assert np.abs((found - expected) / np.outer(stds, stds)).max() < 1e-9


def assert_covariance(P) -> None:
    """Assert that P is symmetric to the bit and positive semi-definite but for rounding."""
    assert np.array_equal(P, P.T)
    stds = np.sqrt(np.maximum(np.diag(P), 1e-18))
    assert np.linalg.eigvalsh(P / np.outer(stds, stds)).min() > -1e-8


def stance(foot: int, first: int, last: int, rate: float = 100.0, **options) -> StancePhase:
    """Return a stance of ``foot`` that has ended some epochs ago."""
    given = {"lag": 0.0, "now": last + 8, "period_s": 1.0 / rate, "heading": 0.0, **options}
    return StancePhase(foot=foot, first=first, last=last, **given)


@dataclass
class MadeUpGait:
    """A gait whose past is given by arrays over epochs; forgets nothing unless told."""

    still: np.ndarray  # (2, N) bool
    positions: np.ndarray = field(default_factory=lambda: np.zeros((0, 2, 3)))
    samples: np.ndarray = field(default_factory=lambda: np.zeros((2, 0, 6)))
    period_s: float = 0.01
    oldest: int = 0
    ended: tuple[int, int] = (-1, -1)

    @property
    def now(self) -> int:
        return self.still.shape[1] - 1

    def in_stance(self, foot: int, epoch: int) -> bool:
        return bool(self.still[foot, epoch])

    def positions_after(self, epoch: int) -> np.ndarray:
        return self.positions[epoch]

    def sample(self, foot: int, epoch: int) -> np.ndarray:
        return self.samples[foot, epoch]

    def last_stance_end(self, foot: int) -> int:
        return self.ended[foot]

    def remembers(self, epoch: int) -> bool:
        return self.oldest <= epoch + 1 <= self.now

    def stamp(self, epoch: int, default: int = 0) -> int:
        return round(epoch * self.period_s * 1e9)
