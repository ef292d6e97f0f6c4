"""The arrays of the kernel: sized, snapshots found in them, bridged over gaps."""

from __future__ import annotations

import math

import numpy as np

from ..samples.series import FloatArray
from . import layout as lay

GAP_SPEED = 1.5  # m/s, how a person may have moved while no data came
GAP_TURN = 0.3  # rad/s


class Workspace:
    """The flat float64 and int64 arrays of one tracker; a snapshot is a copy of ``w[:STATE]``."""

    def __init__(self, rate_hz: float, memory_s: float) -> None:
        """Size the rings to remember ``memory_s`` seconds at ``rate_hz``."""
        self.rate_hz = rate_hz
        self.ring = max(16, math.ceil(memory_s * rate_hz) + 2)
        self.w = np.zeros(lay.workspace_size(self.ring))
        self.n = np.zeros(lay.integer_size(self.ring), dtype=np.int64)
        self.stamps = np.zeros(self.ring, dtype=np.int64)
        self.n[lay.N_RING] = self.ring
        self.n[lay.N_EPOCH] = -1

    @property
    def epoch(self) -> int:
        """Newest epoch, -1 before the first."""
        return int(self.n[lay.N_EPOCH])

    @property
    def oldest(self) -> int:
        """Oldest epoch to which the filter can be rolled back."""
        return int(self.n[lay.N_OLDEST])

    def foot(self, foot: int, item: str) -> int:
        """Return an integer of the phase machine of ``foot``: N_PHASE, N_START or N_LEAVE."""
        return int(self.n[lay.N_FOOT + foot * lay.N_STRIDE + getattr(lay, item)])

    def snapshot(self, epoch: int) -> FloatArray:
        """Return the state (STATE,) before ``epoch`` as a view."""
        start = lay.RINGS + lay.SAMPLE * self.ring + lay.STATE * (epoch % self.ring)
        return self.w[start : start + lay.STATE]

    def states(self) -> list[int]:
        """Return the index of the present state and of every valid snapshot."""
        first = lay.RINGS + lay.SAMPLE * self.ring
        epochs = range(self.oldest, self.epoch + 1)
        return [0, *(first + lay.STATE * (epoch % self.ring) for epoch in epochs)]

    def bridge(self, gap_s: float) -> None:
        """Get over ``gap_s`` s without data: unknown velocity, a position that may have moved."""
        for foot in range(2):
            o, block = foot * lay.FOOT, lay.PLL if foot == 0 else lay.PRR
            for item, size in ((lay.VEL, 3), (lay.ALPHA, 3), (lay.GAMMA, 3), (lay.FOLLOWS, 1)):
                self.w[o + item : o + item + size] = 0.0
            rows = self.w[block : block + lay.BLOCK].reshape(15, lay.ROW)
            cross = self.w[lay.PLR : lay.PLR + lay.BLOCK].reshape(15, lay.ROW)
            velocity = slice(lay.E_VEL, lay.E_VEL + 3)
            rows[velocity] = rows[:, velocity] = 0.0
            if foot == 0:
                cross[velocity] = 0.0
            else:
                cross[:, velocity] = 0.0
            for i in range(3):
                rows[lay.E_VEL + i, lay.E_VEL + i] = GAP_SPEED**2
                rows[lay.E_POS + i, lay.E_POS + i] += (GAP_SPEED * gap_s) ** 2
                rows[lay.E_ATT + i, lay.E_ATT + i] += (GAP_TURN * min(gap_s, 10.0)) ** 2
            self.n[lay.N_FOOT + foot * lay.N_STRIDE + lay.N_PHASE] = lay.SWING
        self.forget()

    def forget(self) -> None:
        """Make every snapshot invalid: there is no going back from here."""
        self.n[lay.N_OLDEST] = self.n[lay.N_EPOCH] + 1

    def own_block(self, foot: int) -> FloatArray:
        """Return the covariance (15, 15) of a foot's own error state, as a view."""
        block = lay.PLL if foot == 0 else lay.PRR
        return self.w[block : block + lay.BLOCK].reshape(15, lay.ROW)[:, :15]

    def blocks(self) -> FloatArray:
        """Return a copy of the covariance blocks (3 BLOCK,): left, right, cross."""
        return self.w[lay.PLL : lay.STATE].copy()

    def covariance(self) -> FloatArray:
        """Return the full covariance (30, 30): left foot's error state, then the right foot's."""
        return joint_covariance(self.w[lay.PLL : lay.STATE])


def joint_covariance(blocks: FloatArray) -> FloatArray:
    """Return the full covariance (30, 30) of the blocks (3 BLOCK,) left, right, cross."""
    ll, rr, lr = blocks.reshape(3, 15, lay.ROW)[:, :, :15]
    return np.block([[ll, lr], [lr.T, rr]])
