"""The windows of a whole series, many at once: those that :class:`WindowSlider` gives singly."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..samples.series import BoolArray, FloatArray, IntArray
from .window import Window, slide_ns
from .windows_ahead import TOGETHER, moments, window_begins, window_ends


@dataclass(frozen=True)
class WholeWindows:
    """Windows over a series, in order.

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
        first, last = _bounds(stamp_ns, seconds)
        return cls(stamp_ns[last], *moments(values, first, last), _exact(seconds))

    @classmethod
    def newest_first(
        cls, stamp_ns: IntArray, values: FloatArray, seconds: float
    ) -> Iterator[WholeWindows]:
        """Yield the windows of `over` in parts from the end, each made when it is asked for."""
        first, last = _bounds(stamp_ns, seconds)
        for stop in range(len(last), 0, -TOGETHER):
            part = slice(max(0, stop - TOGETHER), stop)
            mean, std = moments(values, first[part], last[part])
            yield cls(stamp_ns[last[part]], mean, std, _exact(seconds))

    def __len__(self) -> int:
        """Return the number of windows."""
        return len(self.end_ns)

    def window(self, index: int) -> Window:
        """Return one of them."""
        end_ns = int(self.end_ns[index])
        return Window(self.mean[index].tolist(), self.std[index].tolist(), end_ns, self.seconds)

    def scatter_below(self, force_std: float, rate_std: float) -> BoolArray:
        """Return (W,) where the largest scatter about an axis is no more than these."""
        force, rate = self.std[:, :3].max(axis=1), self.std[:, 3:].max(axis=1)
        below: BoolArray = (force <= force_std) & (rate <= rate_std)
        return below


def _bounds(stamp_ns: IntArray, seconds: float) -> tuple[IntArray, IntArray]:
    """Return the first and the last samples (W,) of the windows of so many seconds."""
    length_ns = round(seconds * 1e9)
    begins, full = window_begins(stamp_ns, length_ns)
    ends, _ = window_ends(stamp_ns, full, slide_ns(length_ns))
    last = np.array(ends, dtype=np.int64)
    return begins[last], last


def _exact(seconds: float) -> float:
    """Return the length of a window of ``seconds`` in whole nanoseconds, s."""
    return round(seconds * 1e9) * 1e-9
