"""A short form of ``python -m benchmark.endurance``: what must hold over many epochs."""

import numpy as np
import pytest

from benchmark.endurance import run_epochs, soak
from dualfoot_ros.core.kernel import Workspace
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.strapdown import orthonormalise

pytest.importorskip("numba")


def test_covariance_and_attitudes_stay_what_they_are_over_many_epochs():
    worst = run_epochs(60_000, rate=60.0)
    assert worst.checks >= 3
    assert worst.finite
    assert worst.asymmetry == 0.0
    assert worst.least_eigenvalue > 0.0
    assert worst.skewness < 1e-12


def test_memory_does_not_grow_with_the_length_of_a_walk():
    held = soak(0.025, rate=60.0)
    assert held[-1].resident_mib - held[2].resident_mib < 2.5
    assert held[-1].blocks - held[2].blocks < 100  # of 300 000
    assert not held[-1].allocated_mib - held[2].allocated_mib > 0.1  # nan where it is not told


@pytest.mark.parametrize("foot", [0, 1])
def test_an_attitude_that_has_lost_its_shape_gets_it_back(foot):
    space = Workspace(60.0, 1.0)
    rng = np.random.default_rng(3)
    true = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    start = foot * lay.FOOT + lay.ROT
    space.w[start : start + 9] = (true + 1e-7 * rng.normal(size=(3, 3))).ravel()
    orthonormalise(space.w, foot)
    R = space.w[start : start + 9].reshape(3, 3)
    assert np.allclose(R.T @ R, np.eye(3), atol=1e-13)
    assert np.allclose(R, true, atol=5e-7)
