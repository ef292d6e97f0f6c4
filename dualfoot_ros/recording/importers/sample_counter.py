"""Device counters of 32 bits, in microseconds, to stamps that do not wrap."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...core import IntArray

WRAP_US = 2**32


def unwrap_us(counter: ArrayLike) -> IntArray:
    """Return (N,) ns from a (N,) 32-bit microsecond counter, signed or not, that may wrap.

    The first stamp is the counter taken as unsigned; successive samples are taken to be less
    than half a wrap (35 min) apart, forwards or backwards.
    """
    unsigned = np.rint(np.asarray(counter, dtype=np.float64)).astype(np.int64) % WRAP_US
    if not len(unsigned):
        return unsigned
    steps = (np.diff(unsigned) + WRAP_US // 2) % WRAP_US - WRAP_US // 2
    stamp_ns: IntArray = (unsigned[0] + np.concatenate(([0], np.cumsum(steps)))) * 1000
    return stamp_ns


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
