"""What is prepared for a gain that takes some states as known."""

import numpy as np
import pytest

from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.schmidt.considered_states import (
    consider_all,
    consider_common,
    consider_foot,
)
from dualfoot_ros.core.kernel.schmidt.considered_update import considering_gain
from dualfoot_ros.core.kernel.schmidt.stance_gain import knowing_all, knowing_foot

from .states import random_workspace


def measured(seed: int) -> np.ndarray:
    """Return the state of a workspace in which G = P H', S and the innovation are prepared."""
    w = random_workspace(seed).w
    w[lay.S_G : lay.S_G + lay.ROWS_MOST * lay.JOINT] = 1e-4
    w[lay.S_S : lay.S_S + 9] = np.eye(3).ravel()
    return w


def unread(w: np.ndarray, size: int) -> np.ndarray:
    """Return what stands behind the columns of ``size`` states in their rows of P_cc."""
    rows = w[lay.S_CC : lay.S_GC].reshape(lay.CONSIDERED, lay.ROW_CC)
    return rows[:size, size : lay.X_CC].copy()


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("before", ["all", "common"])
def test_what_an_update_with_more_states_has_left_does_not_grow_in_those_with_fewer(before):
    """Rows were scaled as a whole: it overflowed on a walk, though nothing read it."""
    w = measured(1)
    if before == "all":
        consider_all(w)
        knowing_all(w)
    else:
        consider_common(w)
        considering_gain(w, lay.CONSIDERED)
    left = unread(w, lay.CONSIDERED_FOOT)
    assert left.any()
    for _ in range(200):
        consider_foot(w, lay.PLL, 0)
        knowing_foot(w, lay.PLL, 0)
    assert np.array_equal(unread(w, lay.CONSIDERED_FOOT), left)


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_nor_in_those_of_both_feet():
    w = measured(2)
    consider_common(w)
    considering_gain(w, lay.CONSIDERED)
    left = unread(w, 2 * lay.CONSIDERED_FOOT)
    assert left.any()
    for _ in range(200):
        consider_all(w)
        knowing_all(w)
    assert np.array_equal(unread(w, 2 * lay.CONSIDERED_FOOT), left)
