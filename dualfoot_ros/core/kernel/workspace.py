"""The arrays of the kernel: sized, snapshots found in them, bridged over gaps."""

from __future__ import annotations

import math

import numpy as np

from ..samples.series import FloatArray
from . import layout as lay

GAP_SPEED = 1.5  # m/s, how a person may have moved while no data came
MISSED_SHARE = 0.2  # of the change over a hole
MISSED_FORCE, MISSED_RATE = 2.0, 0.5  # m/s^2 and rad/s
PHASE_ITEMS = {"N_PHASE": lay.N_PHASE, "N_START": lay.N_START, "N_LEAVE": lay.N_LEAVE}
LONGEST_GAP_S = 60.0  # beyond which a person is not farther away


class Workspace:
    """The flat float64 and int64 arrays of one tracker; a snapshot is a copy of ``w[:STATE]``."""

    def __init__(self, rate_hz: float, memory_s: float) -> None:
        """Size the rings to remember ``memory_s`` seconds at ``rate_hz``."""
        self.rate_hz = rate_hz
        self.ring = max(16, math.ceil(memory_s * rate_hz) + 2)
        self.w = from_a_line(lay.workspace_size(self.ring))
        self.n = np.zeros(lay.integer_size(self.ring), dtype=np.int64)
        self.stamps = np.zeros(self.ring, dtype=np.int64)
        self.n[lay.N_RING] = self.ring
        self.n[lay.N_EPOCH] = self.n[lay.N_UNEVEN] = -1
        self.w[lay.C_PERIOD] = 1.0 / rate_hz

    @property
    def epoch(self) -> int:
        """Newest epoch, -1 before the first."""
        return self.n.item(lay.N_EPOCH)

    @property
    def oldest(self) -> int:
        """Oldest epoch to which the filter can be rolled back."""
        return self.n.item(lay.N_OLDEST)

    def foot(self, foot: int, item: str) -> int:
        """Return an integer of the phase machine of ``foot``: N_PHASE, N_START or N_LEAVE."""
        return self.n.item(lay.N_FOOT + foot * lay.N_STRIDE + PHASE_ITEMS[item])

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
        """Get over ``gap_s`` s without data: the feet may have moved, and no phase goes on."""
        moved = (GAP_SPEED * min(gap_s, LONGEST_GAP_S)) ** 2
        for foot in range(2):
            rows = self.own_block(foot)
            for i in range(lay.E_POS, lay.E_POS + 3):
                rows[i, i] += moved
            phase = lay.N_FOOT + foot * lay.N_STRIDE
            self.n[phase + lay.N_PHASE] = lay.SWING
            self.n[phase + lay.N_BACK] = self.epoch + 1
        self.forget()

    def blur(self, seconds: float, change: FloatArray) -> None:
        """Add what samples on a line do not know of a hole of ``seconds`` s.

        ``change`` (12,) is that of the samples over the hole; the mean of what was missed differs
        from that of the line by a share of it, and by as much as a foot in motion always may.
        """
        for foot in range(2):
            force, rate = change[6 * foot : 6 * foot + 3], change[6 * foot + 3 : 6 * foot + 6]
            if not np.isfinite(force).all():
                continue
            speed = seconds * math.hypot(MISSED_SHARE * float(np.abs(force).max()), MISSED_FORCE)
            turn = seconds * math.hypot(MISSED_SHARE * float(np.abs(rate).max()), MISSED_RATE)
            rows = self.own_block(foot)
            for i in range(3):
                rows[lay.E_POS + i, lay.E_POS + i] += (0.5 * seconds * speed) ** 2
                rows[lay.E_VEL + i, lay.E_VEL + i] += speed**2
                rows[lay.E_ATT + i, lay.E_ATT + i] += turn**2

    def forget(self) -> None:
        """Make every snapshot invalid: there is no going back from here."""
        self.n[lay.N_OLDEST] = self.n[lay.N_EPOCH] + 1

    def own_block(self, foot: int) -> FloatArray:
        """Return the covariance (15, 15) of a foot's own error state, as a view."""
        block = lay.PLL if foot == 0 else lay.PRR
        return self.w[block : block + lay.BLOCK].reshape(15, lay.ROW)[:, :15]

    def put_covariance(self, covariance: FloatArray) -> None:
        """Write the full covariance (30, 30); of symmetric elements those above the diagonal."""
        P = np.triu(covariance) + np.triu(covariance, 1).T
        for start, part in (
            (lay.PLL, P[:15, :15]),
            (lay.PRR, P[15:, 15:]),
            (lay.PLR, P[:15, 15:]),
        ):
            self.w[start : start + lay.BLOCK].reshape(15, lay.ROW)[:, :15] = part

    def covariance(self) -> FloatArray:
        """Return the full covariance (30, 30): left foot's error state, then the right foot's."""
        return joint_covariance(self.w[lay.PLL : lay.STATE])


def from_a_line(size: int) -> FloatArray:
    """Return an array (size,) of zeros that begins at a line of the cache, as the layout does."""
    numbers = np.zeros(size + lay.LINE)
    first = -numbers.ctypes.data // numbers.itemsize % lay.LINE
    return numbers[first : first + size]


def joint_covariance(blocks: FloatArray) -> FloatArray:
    """Return the full covariance (30, 30) of the blocks (3 BLOCK,) left, right, cross."""
    ll, rr, lr = blocks.reshape(3, 15, lay.ROW)[:, :, :15]
    return np.block([[ll, lr], [lr.T, rr]])
