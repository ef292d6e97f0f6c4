"""An update from its rows on: both forms of the kernel, and dense matrices."""

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay

from ...dense import joseph
from ..states import random_workspace
from .forms import both_forms, numbers

KINDS = (lay.KNOW_NOTHING, lay.KNOW_ALL, lay.KNOW_COMMON, lay.KEEP_PLACE)


def measured(seed: int, rows: int):
    """Return a random state with ``rows`` random rows in place, their H, and their numbers."""
    space, rng, x = random_workspace(seed), np.random.default_rng(seed), numbers()
    H = np.zeros((rows, lay.JOINT))
    H[:, : lay.ERRORS], H[:, lay.SIDE : lay.SIDE + lay.ERRORS] = rng.normal(size=(2, rows, 15))
    space.w[lay.S_H : lay.S_H + H.size] = H.ravel()
    x[lay.X_Y : lay.X_Y + rows] = 0.1 * rng.normal(size=rows)
    x[lay.X_NOISE : lay.X_NOISE + rows] = 0.01
    return space, np.delete(H, [15, 31], axis=1), x


@pytest.mark.parametrize("rows", (1, 2, 3))
@pytest.mark.parametrize("kind", KINDS)
def test_both_forms_have_the_same_bits(kind, rows):
    space, _, x = measured(rows, rows)
    nis, _ = both_forms("observe", space.w, x, given=(rows, kind))
    assert nis > 0.0


@pytest.mark.parametrize("rows", (1, 2, 3))
def test_it_is_the_dense_update(rows):
    space, H, x = measured(10 + rows, rows)
    P, y = space.covariance(), x[lay.X_Y : lay.X_Y + rows].copy()
    nis = interpreted().observe(space.w, x, rows, lay.KNOW_NOTHING)
    _, expected, S, nis_dense = joseph(P, H, 0.01 * np.eye(rows), y)
    stds = np.sqrt(np.diag(P))
    assert np.abs((space.covariance() - expected) / np.outer(stds, stds)).max() < 1e-9
    assert np.allclose(x[lay.X_S : lay.X_S + 9].reshape(3, 3)[:rows, :rows], S, rtol=1e-11)
    assert nis == pytest.approx(nis_dense, rel=1e-8)


def test_what_an_exact_row_has_settled_stays_settled():
    space, _, x = measured(4, 1)
    x[lay.X_NOISE] = 0.0
    interpreted().observe(space.w, x, 1, lay.KNOW_NOTHING)
    settled = space.w[: lay.STATE].copy()
    x[lay.X_Y] = 0.5
    assert interpreted().observe(space.w, x, 1, lay.KNOW_NOTHING) == 0.0
    assert np.array_equal(space.w[: lay.STATE], settled)


@pytest.mark.parametrize(("right", "observed"), ((0.0, True), (-1.0, False)))
def test_a_height_ends_its_drift_and_a_difference_of_heights_does_not(right, observed):
    space, _, x = measured(5, 1)
    space.w[lay.S_H : lay.S_H + lay.JOINT] = 0.0
    space.w[lay.S_H + 2], space.w[lay.S_H + lay.SIDE + 2] = 1.0, right
    space.w[lay.WALKED] = 7.0
    interpreted().observe(space.w, x, 1, lay.KNOW_NOTHING)
    assert space.w[lay.WALKED] == (0.0 if observed else 7.0)
