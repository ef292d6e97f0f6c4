"""The end of a stance as one entry of the kernel: its moment, and what is left to Python."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.constraints.at_passing import rule_of
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.at_stances.stance_end import lag_of, share_of_stance

from ..states import random_workspace
from .forms import both_forms, numbers

FIRST, LAST, NOW = 4, 10, 12


@given(
    st.integers(0, 10**7),
    st.integers(0, 400),
    st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 0.25, 0.5, 1.0])),
    st.integers(2, 20),
)
def test_the_moment_is_rounded_as_python_rounds(first, length, share, window):
    last, lag = first + length, lag_of(window)
    exact = (1.0 - share) * first + share * last - lag
    assert share_of_stance(first, last, share, lag) == round(exact)


def ended(kind: float):
    """Return the arrays of a walk in which a stance of the right foot has just ended."""
    space = random_workspace(5)
    w, n = space.w, space.n
    n[lay.N_EPOCH], n[lay.N_WINDOW], w[lay.C_PERIOD] = NOW, 3, 0.01
    right = lay.N_FOOT + lay.N_STRIDE
    n[right + lay.N_START], n[right + lay.N_LEAVE] = FIRST, LAST + 1
    for epoch in range(NOW + 1):
        space.snapshot(epoch)[:] = w[: lay.STATE]
        sample = lay.RINGS + lay.SAMPLE * (epoch % space.ring)
        w[sample : sample + 13] = [0.01, *([0.1, 0.2, 9.8, 0.01, 0.0, 0.02] * 2)]
    learnt = np.zeros(lay.L_SIZE)
    learnt[lay.L_STATE], learnt[lay.L_COVARIANCE] = 0.1, 0.01
    rule = {
        lay.R_KIND: kind,
        lay.R_SHARE: 0.5,
        lay.R_LONGEST_S: 1.0,
        lay.R_STD: 0.1,
        lay.R_LEFT_ALONE: lay.KNOW_COMMON,
        lay.R_ROWS: 2,
        lay.R_LEARNS: 1,
    }
    return w, n, numbers(), rule_of(rule), learnt


@pytest.mark.parametrize("kind", (lay.R_SPACING, lay.R_DISTANCE))
@pytest.mark.parametrize(
    ("change", "gate", "since", "done"),
    [
        ({}, 1e9, -1, lay.END_DONE),
        ({}, 1e9, 6, lay.END_DONE),
        ({}, 1e9, 7, lay.END_ASK),  # something has been applied since
        ({}, 1e-9, -1, lay.END_ASK),  # it does not fit
        ({"longest": 0.06}, 1e9, -1, lay.END_NO_STEP),
        ({"stands": True}, 1e9, -1, lay.END_NO_STEP),
        ({"oldest": 8}, 1e9, -1, lay.END_NO_STEP),
    ],
)
def test_both_forms_do_the_same_or_leave_it(kind, change, gate, since, done):
    w, n, x, rule, learnt = ended(kind)
    rule[lay.R_LONGEST_S] = change.get("longest", 1.0)
    n[lay.N_OLDEST] = change.get("oldest", 0)
    n[lay.N_FLAGS + 6] = int("stands" in change)
    arrays = w, n, x, rule, learnt
    found, after = both_forms("end_stance", *arrays, given=(1, 0.6, 0.8, gate, since))
    assert found == done
    assert after[1][lay.N_MOMENT] == 6
    changed = [not np.array_equal(a, b) for a, b in zip(after, arrays, strict=True)]
    assert changed[4] == (done == lay.END_DONE)  # it has learnt
    if done == lay.END_NO_STEP:
        assert not changed[0]


def test_feet_that_are_near_enough_are_left_alone_and_teach_the_spacing():
    w, n, x, rule, learnt = ended(lay.R_DISTANCE)
    learnt[lay.L_STATE] = 1e6
    found, after = both_forms("end_stance", w, n, x, rule, learnt, given=(1, 0.6, 0.8, 1e9, 7))
    assert found == lay.END_DONE
    assert np.array_equal(after[0], w)
    assert after[2][lay.X_EXCEEDS] == 0.0
    assert after[4][lay.L_BEGUN] == 1.0
