"""What the tracker remembers of the recent past, as the constraint methods may ask for it."""

from __future__ import annotations

import math

import numpy as np

from .kernel import Workspace
from .kernel import layout as lay
from .samples.series import FloatArray

UNEVEN_S = 1.5e-3  # rms of the intervals about their median, of stamps as of arrivals


class GaitHistory:
    """A view of the rings: samples, snapshots, flags and stamps of the last second or so."""

    def __init__(self, space: Workspace) -> None:
        """Look at ``space``."""
        self._space, self._ring = space, space.ring
        self._n, self._stamps = space.n, space.stamps
        self.period_s = 1.0 / space.rate_hz
        self.ended = [-1, -1]

    @property
    def now(self) -> int:
        """Newest epoch."""
        return self._space.epoch

    def sample(self, foot: int, epoch: int) -> FloatArray:
        """Return specific force and bias-free angular rate (6,) of ``foot`` at ``epoch``."""
        w, ring = self._space.w, self._space.ring
        start = lay.RINGS + lay.SAMPLE * (epoch % ring) + 1 + 6 * foot
        bias = foot * lay.FOOT + lay.BG
        values = w[start : start + 6].copy()
        values[3:] -= w[bias : bias + 3]
        return values

    def last_stance_end(self, foot: int) -> int:
        """Return the last epoch of the last stance of ``foot`` that has ended, -1 for none."""
        return self.ended[foot]

    def in_stance(self, foot: int, epoch: int) -> bool:
        """Return whether ``foot`` had zero velocity at ``epoch``."""
        flags = self._n.item(lay.N_FLAGS + epoch % self._ring)
        return bool((flags >> foot) & 1)

    @property
    def uneven(self) -> bool:
        """Whether stamps are so uneven that a swing tells no velocity of the landing."""
        newest = self._n.item(lay.N_EPOCH)
        count = min(self._ring, newest + 1)
        # Nearly always all are nearly nominal, and to look at each of them takes long.
        if self._n.item(lay.N_UNEVEN) <= newest - count:
            return False
        steps = self._space.w[lay.RINGS : lay.RINGS + lay.SAMPLE * count : lay.SAMPLE]
        if steps.max() - steps.min() < 0.99 * UNEVEN_S:
            return False
        off = steps - np.median(steps)
        return math.sqrt(float(off @ off) / count) > UNEVEN_S

    def remembers(self, epoch: int) -> bool:
        """Return whether the filter can be rolled back to just after ``epoch``."""
        n = self._n
        return bool(n.item(lay.N_OLDEST) <= epoch + 1 <= n.item(lay.N_EPOCH))

    def positions_after(self, epoch: int) -> FloatArray:
        """Return both feet's positions (2, 3) m as estimated at ``epoch``."""
        state = self._space.snapshot(epoch + 1)
        feet = state[: 2 * lay.FOOT].reshape(2, lay.FOOT)
        return feet[:, lay.POS : lay.POS + 3].copy()

    def stamp(self, epoch: int, default: int = 0) -> int:
        """Return the stamp in ns of ``epoch``, or ``default`` when it is forgotten."""
        newest = self._n.item(lay.N_EPOCH)
        if newest - self._ring < epoch <= newest:
            return self._stamps.item(epoch % self._ring)
        return default
