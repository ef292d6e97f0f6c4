"""Self-test of the fit: a known matrix put on the samples must come back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core import FloatArray
from .filter_terms import symmetric
from .foot_walk import FootWalk
from .gyro_matrix import GyroMatrixFit, fit_matrix

SPREAD = 0.004  # of the elements that are put on
ALLOWED = 0.0008
SEED = 20


@dataclass(frozen=True)
class SelfTest:
    """What was put on the samples (6,), and what of it came back (6,) as the prior lets it."""

    put: FloatArray
    found: FloatArray

    @property
    def error(self) -> float:
        """Largest difference of an element."""
        return float(np.abs(self.found - self.put).max())

    @property
    def passed(self) -> bool:
        """Whether the known matrix came back."""
        return self.error <= ALLOWED


def self_test(walks: Sequence[FootWalk], fit: GyroMatrixFit) -> SelfTest:
    """Put a random matrix on the samples of ``walks``, and fit again.

    The prior draws every fit towards zero, by a share that is known from the covariance; that
    share is given back, so what is compared is what the walks tell.
    """
    put = SPREAD * np.random.default_rng(SEED).standard_normal(6)
    distort = np.linalg.inv(np.eye(3) + symmetric(put)).T
    distorted = [replace(walk, rate=walk.rate @ distort) for walk in walks]
    again = fit_matrix(distorted, (float(fit.start[6]), float(fit.start[7])), fit.noise)
    drawn = fit.covariance[:6] @ np.concatenate([put / fit.noise.matrix**2, np.zeros(2)])
    return SelfTest(put, again.elements - fit.elements + drawn)
