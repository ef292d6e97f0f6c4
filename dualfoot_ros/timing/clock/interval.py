"""The interval of a link that delivers at certain events only, found from when it delivers."""

from __future__ import annotations

import math

import numpy as np

from ...core import BoolArray, FloatArray

INTERVALS_S = np.arange(0.0075, 0.06, 0.00005)  # 7.5 ms is the shortest of Bluetooth Low Energy
LONGEST_S = 0.4  # time between arrivals that is looked at
NEAR_S = 0.0007  # a time so close to a multiple is one; the host adds some tenths of a ms
ENOUGH = 0.6  # share of the times that must be multiples, beyond chance
MOST_PARTS = 50
SAME = 0.03


def find_interval(time_s: FloatArray, arrival_s: FloatArray) -> float | None:
    """Return the interval in s of which the times between arrivals (n,) are multiples.

    ``time_s`` (n,) are device times.  None when there is no such interval, or when it is as long
    as the device's own period or longer: then the device may be what keeps the time.
    """
    longest = (1.0 - SAME) * own_period(time_s)
    intervals = INTERVALS_S[longest > INTERVALS_S]
    apart = np.diff(arrival_s)
    apart = apart[apart < LONGEST_S]
    if len(intervals) == 0 or len(apart) < len(time_s) // 2:
        return None
    chance = 2.0 * NEAR_S / intervals
    share = _multiples(apart, intervals[:, None]).mean(axis=1)
    share = (share - chance) / (1.0 - chance)
    # Its parts explain as much as an interval does: the longest that misses one at most.
    best = int(np.flatnonzero(share >= share.max() - 1.5 / len(apart))[-1])
    if share[best] < ENOUGH:
        return None
    interval = _refined(apart, float(intervals[best]))
    while (parts := _parts(apart, interval)) > 1:
        interval = _refined(apart, parts * interval)
    return interval if interval < longest else None


def own_period(time_s: FloatArray) -> float:
    """Return the device's period in s: the smallest difference of times (n,) or of their steps."""
    steps = np.sort(np.diff(time_s))
    differences = np.diff(steps, prepend=0.0)
    return float(differences[differences > NEAR_S].min(initial=np.inf))


def _multiples(apart: FloatArray, interval: float | FloatArray) -> BoolArray:
    """Tell which of the times are near a multiple of an interval."""
    count = np.round(apart / interval)
    return (np.abs(apart - count * interval) < NEAR_S) & (count > 0)


def _refined(apart: FloatArray, interval: float) -> float:
    """Return the interval by least squares from what are its multiples."""
    for _ in range(3):
        near = apart[_multiples(apart, interval)]
        count = np.round(near / interval)
        interval = float(near @ count / (count @ count))
    return interval


def _parts(apart: FloatArray, interval: float) -> int:
    """Return how many of ``interval`` make an interval that leaves to it what chance does."""
    chance = 2.0 * NEAR_S / interval
    for parts in range(2, MOST_PARTS + 1):
        others = apart[~_multiples(apart, parts * interval)]
        expected, seen = chance * len(others), int(_multiples(others, interval).sum())
        at_most = expected + 3.0 * math.sqrt(expected * (1.0 - chance))
        if seen <= at_most:
            return parts
    return 1
