"""The windows of a whole series at once: those that a :class:`WindowSlider` gives one by one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..samples.series import BoolArray, FloatArray, IntArray
from .window import FEWEST_SAMPLES, Window, slide_ns

TOGETHER = 256  # windows whose samples are laid side by side: some megabytes


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
        first, last = _spans(stamp_ns, round(seconds * 1e9))
        mean, std = np.empty((len(first), 6)), np.empty((len(first), 6))
        counts = last - first + 1
        for count in np.unique(counts):
            alike = np.flatnonzero(counts == count)
            for at in np.array_split(alike, -(-len(alike) // TOGETHER)):
                mean[at], std[at] = _moments(values[first[at] + np.arange(count)[:, None]])
        return cls(stamp_ns[last], mean, std, round(seconds * 1e9) * 1e-9)

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


def _spans(stamp_ns: IntArray, length_ns: int) -> tuple[IntArray, IntArray]:
    """Return first and last sample (W,) of each window.

    A window ends with a sample when one leaves it there, and no sooner than a slide after the one
    before.
    """
    begins = np.searchsorted(stamp_ns, stamp_ns - length_ns, side="right")
    left = np.diff(begins, prepend=0) > 0
    enough = np.arange(len(stamp_ns)) - begins + 1 >= FEWEST_SAMPLES
    step_ns, due_ns = slide_ns(length_ns), None
    last = []
    for k in np.flatnonzero(left & enough).tolist():
        stamp = int(stamp_ns[k])
        if due_ns is None or stamp >= due_ns:
            due_ns = max(due_ns or stamp, stamp - step_ns) + step_ns
            last.append(k)
    ends = np.array(last, dtype=np.int64)
    return begins[ends], ends


def _moments(block: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return mean and scatter (W, 6) of samples (N, W, 6), summed as ``Window.of`` does."""
    mean = block.sum(axis=0) / len(block)
    off = block - mean
    return mean, np.sqrt((off * off).sum(axis=0) / len(block))
