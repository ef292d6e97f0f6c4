"""The spacing of the feet as one entry of the kernel: both forms, and its closed form."""

import math

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.turn import LONG_S

from ...dense import joseph
from ..states import random_workspace
from .forms import both_forms, numbers

HEADING, SPACING, STD, HEIGHT_STD = 0.7, 0.15, 0.08, 0.12
LEFT = np.array([-math.sin(HEADING), math.cos(HEADING), 0.0])


def given(*, lateral=False, height_std=HEIGHT_STD, kind=lay.KNOW_NOTHING):
    """Return what the entry is given beside the arrays."""
    ahead = math.cos(HEADING), math.sin(HEADING)
    return (*ahead, SPACING, STD, height_std, int(lateral), kind)


@pytest.mark.parametrize("lateral", (False, True))
@pytest.mark.parametrize("height_std", (0.0, HEIGHT_STD))
@pytest.mark.parametrize("kind", (lay.KNOW_NOTHING, lay.KNOW_ALL, lay.KNOW_COMMON))
@pytest.mark.parametrize("tracked_s", (10.0, 2.0 * LONG_S))
def test_both_forms_have_the_same_bits(lateral, height_std, kind, tracked_s):
    space = random_workspace(3)
    space.w[lay.TRACKED] = tracked_s
    options = given(lateral=lateral, height_std=height_std, kind=kind)
    nis, _ = both_forms("constrain_spacing", space.w, numbers(), given=options)
    assert nis > 0.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("lateral", (False, True))
def test_it_is_the_dense_update_and_says_what_it_did(seed, lateral):
    space, x = random_workspace(seed), numbers()
    P, w = space.covariance(), space.w
    r = w[lay.POS : lay.POS + 3] - w[lay.FOOT + lay.POS : lay.FOOT + lay.POS + 3]
    nis = interpreted().constrain_spacing(w, x, *given(lateral=lateral))
    directions = np.array([LEFT, [0, 0, 1]]) if lateral else np.eye(3)
    stds = [STD, HEIGHT_STD] if lateral else [STD, STD, HEIGHT_STD]
    H = np.zeros((len(directions), 30))
    H[:, 0:3], H[:, 15:18] = directions, -directions
    y = directions @ (r - SPACING * LEFT)
    error, expected, S, nis_dense = joseph(P, H, np.diag(np.square(stds)), y)
    scale = np.sqrt(np.diag(P))
    assert np.abs((space.covariance() - expected) / np.outer(scale, scale)).max() < 1e-9
    assert nis == pytest.approx(nis_dense, rel=1e-8)
    rows = len(directions)
    assert np.allclose(x[lay.X_Y : lay.X_Y + rows], y, atol=1e-12)
    assert np.allclose(x[lay.X_S : lay.X_S + 9].reshape(3, 3)[:rows, :rows], S, rtol=1e-9)
    assert np.allclose(x[lay.X_BEFORE : lay.X_BEFORE + 3], r, atol=1e-15)
    after = r - (error[0:3] - error[15:18])
    assert np.allclose(x[lay.X_AFTER : lay.X_AFTER + 3], after, atol=1e-8)
    assert x[lay.X_DISTANCE] == pytest.approx(np.linalg.norm(r))
    assert x[lay.X_LATERAL] == pytest.approx(float(r @ LEFT))
