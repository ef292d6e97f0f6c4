"""The windows of a whole series at once: those that a :class:`WindowSlider` gives one by one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..samples.series import BoolArray, FloatArray, IntArray
from .window import Window, slide_ns
from .windows_ahead import moments, window_begins, window_ends


@dataclass(frozen=True)
class WholeWindows:
    """The windows over a series, in order.

    Attributes
    ----------
    end_ns : (W,) stamps of their last samples
    mean, std : (W, 6) of specific force, then angular rate
    seconds : their length
    """

    end_ns: IntArray
    mean: FloatArray
    std: FloatArray
    seconds: float

    @classmethod
    def over(cls, stamp_ns: IntArray, values: FloatArray, seconds: float) -> WholeWindows:
        """Return the windows of so many seconds over samples (N, 6) with rising stamps (N,)."""
        length_ns = round(seconds * 1e9)
        begins, full = window_begins(stamp_ns, length_ns)
        ends, _ = window_ends(stamp_ns, full, slide_ns(length_ns))
        last = np.array(ends, dtype=np.int64)
        mean, std = moments(values, begins[last], last)
        return cls(stamp_ns[last], mean, std, length_ns * 1e-9)

    def __len__(self) -> int:
        """Return the number of windows."""
        return len(self.end_ns)

    def window(self, index: int) -> Window:
        """Return one of them."""
        end_ns = int(self.end_ns[index])
        return Window(self.mean[index], self.std[index], end_ns, self.seconds)

    def scatter_below(self, force_std: float, rate_std: float) -> BoolArray:
        """Return (W,) where the largest scatter about an axis is no more than these."""
        force, rate = self.std[:, :3].max(axis=1), self.std[:, 3:].max(axis=1)
        below: BoolArray = (force <= force_std) & (rate <= rate_std)
        return below
