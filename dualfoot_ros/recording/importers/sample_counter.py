"""Counters of samples or ticks that wrap, to numbers that do not."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...core import FloatArray, IntArray

WRAP_US = 2**32
COUNTED = 0.8  # of the samples of a counter are one more than the one before


def unwrapped(counter: ArrayLike, bits: int) -> IntArray:
    """Return the counts (N,) of a counter of ``bits`` bits, signed or not, that may wrap.

    The first is taken as unsigned; successive samples are taken to be less than half a wrap
    apart, forwards or backwards.
    """
    wrap = 1 << bits
    unsigned = np.rint(np.asarray(counter, dtype=np.float64)).astype(np.int64) % wrap
    if not len(unsigned):
        return unsigned
    steps = (np.diff(unsigned) + wrap // 2) % wrap - wrap // 2
    counts: IntArray = unsigned[0] + np.concatenate(([0], np.cumsum(steps)))
    return counts


def unwrap_us(counter: ArrayLike) -> IntArray:
    """Return (N,) ns from a (N,) 32-bit counter of us; half a wrap is 35 min."""
    return unwrapped(counter, 32) * 1000


def counts_samples(values: FloatArray) -> bool:
    """Return whether most of the values (N,) are one more than the one before."""
    whole = np.array_equal(values, np.rint(values)) and bool((values >= 0).all())
    ones = np.diff(values) == 1.0
    return whole and len(values) > 1 and float(ones.mean()) > COUNTED


def bits_of(values: FloatArray) -> int:
    """Return the bits of a counter: those it needs, where it is seen to wrap, else 62."""
    wraps = bool((np.diff(values) < 0).any())
    top = int(values.max())
    return next((bits for bits in (8, 16, 24, 32) if top < 1 << bits), 62) if wraps else 62


def same_wrap(left_ns: IntArray, right_ns: IntArray) -> tuple[IntArray, IntArray]:
    """Move a foot by whole wraps so that both start within half a wrap, and none before zero.

    Devices that share a clock may start on different sides of the wrap.
    """
    if not (len(left_ns) and len(right_ns)):
        return left_ns, right_ns
    wrap_ns = WRAP_US * 1000
    turns = round((int(left_ns[0]) - int(right_ns[0])) / wrap_ns)
    right_ns = right_ns + turns * wrap_ns
    below = min(int(left_ns.min()), int(right_ns.min()))
    lift = wrap_ns * max(0, -(below // wrap_ns))
    return left_ns + lift, right_ns + lift
