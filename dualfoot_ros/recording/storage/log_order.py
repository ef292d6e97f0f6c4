"""The order of the messages of a topic, where the clock of the recorder may have been set."""

from __future__ import annotations

import numpy as np

from ...core import BoolArray, IntArray

BACK_NS = 100_000_000  # by more than this no two messages of a topic are exchanged
LEAST = 5  # messages that are older than one before, so that it was no late one
MOST = 10  # times that a clock is set back in a file; more is disorder
JOINS = 10  # usual intervals between parts that only stand in another order


def recorded_order(log_ns: IntArray, files: IntArray) -> IntArray:
    """Return the order (N,) in which the messages of a topic were recorded.

    ``log_ns`` and ``files`` (N,) are their log times and the numbers of their files, as they stand
    in the files.  In each file it is the order of the log times, unless these go back as those of
    a clock that was set: then it is that of the file.
    """
    parts = []
    for file in np.unique(files):
        own = np.flatnonzero(files == file)
        logged = log_ns[own]
        order = np.arange(len(own)) if _was_set(logged) else np.argsort(logged, kind="stable")
        parts.append(own[order])
    return np.concatenate(parts)


def _was_set(log_ns: IntArray) -> bool:
    """Return whether log times were made by a clock that was set back.

    Parts of a file that only stand in another order join when they are sorted.  After a clock was
    set back, they overlap, or are far apart.
    """
    steps = np.diff(log_ns)
    back = np.flatnonzero(steps < -BACK_NS) + 1
    if not 0 < len(back) <= MOST or not _stays_back(log_ns)[back].all():
        return False
    firsts = log_ns[np.concatenate([[0], back])]
    lasts = log_ns[np.concatenate([back, [len(log_ns)]]) - 1]
    order = np.argsort(firsts)
    apart = firsts[order][1:] - lasts[order][:-1]
    usual_ns = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    return bool(((apart < 0) | (apart > JOINS * usual_ns)).any())


def _stays_back(log_ns: IntArray) -> BoolArray:
    """Return (N,) where this and the next ``LEAST - 1`` are older than the newest before."""
    older = log_ns < np.maximum.accumulate(log_ns)
    stays = older.copy()
    for ahead in range(1, LEAST):
        stays[:-ahead] &= older[ahead:]
        stays[-ahead:] = False
    return stays
