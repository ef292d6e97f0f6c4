"""The velocity with which a foot lands: both forms, and its NIS in matrices."""

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay

from ..states import random_workspace
from .forms import both_forms, numbers

FIRST, NOW, STD = 5, 9, 0.06


def landed(seed: int):
    """Return a workspace at epoch NOW whose feet landed at FIRST, where the state is another."""
    space, then = random_workspace(seed), random_workspace(seed + 100)
    space.n[lay.N_EPOCH], space.n[lay.N_OLDEST] = NOW, 2
    for foot in range(2):
        space.n[lay.N_FOOT + foot * lay.N_STRIDE + lay.N_START] = FIRST
    space.snapshot(FIRST)[:] = then.w[: lay.STATE]
    return space, then


@pytest.mark.parametrize("foot", (0, 1))
def test_both_forms_have_the_same_bits(foot):
    space, _ = landed(1)
    nis, _ = both_forms("landing", space.w, space.n, numbers(), given=(foot, STD))
    assert nis > 0.0


@pytest.mark.parametrize("foot", (0, 1))
@pytest.mark.parametrize("seed", range(3))
def test_it_is_the_velocity_before_the_stance_and_its_nis(foot, seed):
    (space, then), x = landed(seed), numbers()
    nis = interpreted().landing(space.w, space.n, x, foot, STD)
    start = foot * lay.FOOT + lay.VEL
    velocity = then.w[start : start + 3]
    P = then.covariance()[15 * foot :][3:6, 15 * foot :][:, 3:6] + STD**2 * np.eye(3)
    assert x[lay.X_VELOCITY : lay.X_VELOCITY + 3].tolist() == velocity.tolist()
    assert nis == pytest.approx(float(velocity @ np.linalg.solve(P, velocity)), rel=1e-9)


@pytest.mark.parametrize(("oldest", "newest"), ((FIRST + 1, NOW), (2, FIRST - 1)))
def test_what_is_not_remembered_has_none(oldest, newest):
    space, _ = landed(1)
    space.n[lay.N_OLDEST], space.n[lay.N_EPOCH] = oldest, newest
    assert interpreted().landing(space.w, space.n, numbers(), 0, STD) == -1.0
