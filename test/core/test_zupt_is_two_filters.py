"""``zupt`` of the 30-state filter against two independent dense 15-state filters, over a walk."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.row_store import RowStore
from dualfoot_ros.core.samples.pair_series import PairSeries

from .dense import AS_THE_PAPER, DenseFoot
from .harness import open_session, walk


def settled_walk(config: TrackerConfig, seconds: float):
    """Run a walk; return its pairs, the start, the dense feet at the start, flags and states.

    The zero-velocity flags (N, 2) and states (N, STATE) of an epoch are taken from the rings just
    before they forget it: by then no false stance or swing is left in them.
    """
    pairs = walk(seconds)
    session, start = open_session(config, pairs)
    space = session.space
    feet = [DenseFoot.start(config, space.w, foot) for foot in range(2)]
    lag = space.ring - 2
    series, rows = PairSeries.of(*pairs.series()), RowStore(len(pairs))
    flags, states = {}, {}

    def keep(epoch: int) -> None:
        flags[epoch] = int(space.n[lay.N_FLAGS + epoch % space.ring])
        if epoch < space.epoch:
            states[epoch] = space.snapshot(epoch + 1).copy()

    for k in range(start, len(pairs)):
        for _ in session.steps(series, (k, k + 1), rows):
            pass
        if space.epoch - lag >= 0:
            keep(space.epoch - lag)
    for epoch in range(max(0, space.epoch - lag), space.epoch + 1):
        keep(epoch)
    states[space.epoch] = space.w[: lay.STATE].copy()
    return pairs, start, feet, flags, states, session


@pytest.mark.parametrize("lever_arm", (0.0, 0.09))
def test_the_joint_filter_without_constraint_equals_two_filters(lever_arm):
    config = TrackerConfig.from_mapping(
        {
            **AS_THE_PAPER,
            "method": "zupt",
            "heading.source": "sensor",
            "zupt.lever_arm": lever_arm,
            "zupt.still_after": 1e6,
        }
    )
    pairs, start, feet, flags, states, _ = settled_walk(config, 12.0)
    assert sum(f != 0 for f in flags.values()) > 100
    worst = np.zeros(3)
    for epoch in range(len(pairs) - start):
        sample, dt = pairs.values[start + epoch], pairs.dts[start + epoch]
        for foot, dense in enumerate(feet):
            dense.propagate(dt, sample[6 * foot : 6 * foot + 6])
            if flags[epoch] >> foot & 1:
                dense.zupt()
            worst = np.maximum(worst, differences(dense, states[epoch], foot))
    assert worst[0] < 1e-9 * 10.0  # of some ten metres walked
    assert worst[1] < 1e-9
    assert worst[2] < 1e-9


def differences(dense: DenseFoot, state: np.ndarray, foot: int) -> np.ndarray:
    """Return greatest differences of position (m), of the rest of the state, of P (relative)."""
    o, block = foot * lay.FOOT, lay.PRR if foot else lay.PLL
    rest = [
        dense.v - state[o + lay.VEL : o + lay.VEL + 3],
        dense.C.ravel() - state[o + lay.ROT : o + lay.ROT + 9],
        dense.bg - state[o + lay.BG : o + lay.BG + 3],
        dense.ba - state[o + lay.BA : o + lay.BA + 3],
    ]
    P = state[block : block + lay.BLOCK].reshape(15, lay.ROW)[:, :15]
    std = np.sqrt(np.diag(dense.P))
    return np.array(
        [
            np.abs(dense.r - state[o + lay.POS : o + lay.POS + 3]).max(),
            np.abs(np.concatenate(rest)).max(),
            np.abs((P - dense.P) / np.outer(std, std)).max(),
        ]
    )


def test_without_a_constraint_the_feet_never_become_correlated():
    config = TrackerConfig(method="zupt")
    *_, session = settled_walk(config, 12.0)
    assert session.phase == "walking"
    assert not session.space.w[lay.PLR : lay.PLR + lay.BLOCK].any()
