"""Both feet's samples of a whole recording, as the kernel reads them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .pair_gate import good_values, in_range
from .series import BoolArray, FloatArray, ImuSeries, IntArray


@dataclass(frozen=True)
class PairSeries:
    """Stamps (N,) ns, and specific force and angular rate (N, 3) of both feet at each of them."""

    stamp_ns: IntArray
    left_force: FloatArray
    left_rate: FloatArray
    right_force: FloatArray
    right_rate: FloatArray

    @classmethod
    def of(cls, left: ImuSeries, right: ImuSeries) -> PairSeries:
        """Return two series of equal stamps as one of pairs."""
        return cls(
            left.stamp_ns,
            left.specific_force,
            left.angular_rate,
            right.specific_force,
            right.angular_rate,
        )

    def __len__(self) -> int:
        """Return the number of pairs."""
        return len(self.stamp_ns)

    @property
    def arrays(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Force and rate of the left foot, then of the right one."""
        return self.left_force, self.left_rate, self.right_force, self.right_rate

    def values(self, span: slice) -> FloatArray:
        """Return the values (K, 12) of some pairs, as in `ImuPair`."""
        return np.hstack([each[span] for each in self.arrays])

    def good(self, span: slice) -> BoolArray:
        """Return (K,) which pairs have values that the gate takes: nearly always all."""
        if all(in_range(each[span]) for each in self.arrays):
            return np.ones(len(self.stamp_ns[span]), dtype=bool)
        return good_values(self.values(span))

    def present(self, span: slice) -> BoolArray:
        """Return (K, 2) where the left and the right foot have a sample."""
        found: BoolArray = ~np.isnan(
            np.column_stack([self.left_force[span, 0], self.right_force[span, 0]])
        )
        return found
