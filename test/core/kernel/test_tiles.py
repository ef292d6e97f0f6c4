"""Blocks of the covariance turned about their diagonal, and where they stand in memory."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.kernel.tiles import mirror, turn_back, turn_over
from dualfoot_ros.core.kernel.workspace import Workspace

BLOCKS = (lay.PLL, lay.PRR, lay.PLR)


def scratch(w):
    """Return what is at S_A, as a view (16, 16)."""
    return w[lay.S_A : lay.S_A + lay.ROW * lay.ROW].reshape(lay.ROW, lay.ROW)


def block_at(w, block):
    """Return a block with its pads, as a view (15, 16)."""
    return w[block : block + lay.BLOCK].reshape(15, lay.ROW)


@pytest.fixture
def w():
    """Return a workspace in which everything but the pads of its blocks is a number of its own."""
    w = Workspace(100.0, 0.2).w
    w[:] = np.random.default_rng(3).normal(size=len(w))
    for block in BLOCKS:
        block_at(w, block)[:, 15] = 0.0
    scratch(w)[:, 15] = 0.0
    return w


@pytest.mark.parametrize("block", BLOCKS)
def test_a_block_is_turned_over_and_back_and_nothing_else_is_touched(w, block):
    before = w.copy()
    turn_over(w, block, 0, lay.ROW)
    assert np.array_equal(scratch(w)[:15, :15], block_at(before, block)[:, :15].T)
    assert not scratch(w)[15].any() and not scratch(w)[:, 15].any()
    block_at(w, block)[:, :15] = np.nan
    turn_back(w, block)
    scratch(w)[:] = scratch(before)
    assert np.array_equal(w, before)


@pytest.mark.parametrize("block", BLOCKS)
def test_the_upper_triangle_is_taken_for_both_and_nothing_else_is_touched(w, block):
    before = w.copy()
    mirror(w, block)
    upper = np.triu(scratch(before)[:15, :15])
    assert np.array_equal(block_at(w, block)[:, :15], upper + np.triu(upper, 1).T)
    assert not block_at(w, block)[:, 15].any()
    block_at(w, block)[:] = block_at(before, block)
    assert np.array_equal(w, before)


def test_rows_that_are_asked_for_are_turned_over_alone(w):
    before = scratch(w).copy()
    turn_over(w, lay.PLR, 8, 12)
    assert np.array_equal(scratch(w)[8:12, :15], block_at(w, lay.PLR)[:, 8:12].T)
    assert np.array_equal(
        np.delete(scratch(w), range(8, 12), 0), np.delete(before, range(8, 12), 0)
    )


@pytest.mark.parametrize("memory_s", (0.1, 1.57, 3.0))
def test_blocks_begin_at_a_line_of_the_cache(memory_s):
    space = Workspace(100.0, memory_s)
    first = space.w.ctypes.data
    vectors = (lay.S_A, lay.S_G, lay.S_H, lay.S_K, lay.S_PC, lay.S_CC, lay.S_DX)
    for at in (
        *BLOCKS,
        *vectors,
        *(state + block for state in space.states() for block in BLOCKS),
    ):
        assert (first + at * space.w.itemsize) % 64 == 0
