"""Figures of the rows of long arrays, a block of rows at a time: whole copies would be large.

All are to the bit what numpy gives of the whole arrays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .large_arrays import rest
from .series import FloatArray, IntArray

BLOCK = 1 << 14  # rows: what they need stays in the cache of the processor
FEW = 1 << 11  # rows that are far from each other


def row_blocks(count: int) -> Iterator[slice]:
    """Yield the parts of ``count`` rows, in order."""
    for start in range(0, count, BLOCK):
        yield slice(start, min(start + BLOCK, count))
        rest()


def picked(rows: NDArray[Any], at: IntArray | slice) -> NDArray[Any]:
    """Return the rows (K, ...) of an array that an index takes, as ``rows[at]``."""
    if isinstance(at, slice) or len(at) <= FEW:
        return rows[at]
    found = np.empty((len(at), *rows.shape[1:]), dtype=rows.dtype)
    for start in range(0, len(at), FEW):
        found[start : start + FEW] = rows[at[start : start + FEW]]
        rest()
    return found


def row_lengths(vectors: FloatArray) -> FloatArray:
    """Return the lengths (N,) of vectors (N, K)."""
    found = np.empty(len(vectors))
    for part in row_blocks(len(found)):
        found[part] = _lengths(vectors[part])
    return found


def row_distances(one: FloatArray, other: FloatArray) -> FloatArray:
    """Return the distances (N,) of places (N, K) from others."""
    found = np.empty(len(one))
    for part in row_blocks(len(found)):
        found[part] = _lengths(one[part] - other[part])
    return found


def _lengths(vectors: FloatArray) -> FloatArray:
    """Return the lengths (N,) of vectors (N, K): by columns, a sixth of the time of `norm`."""
    first, *others = vectors.T
    total = first * first
    for column in others:
        total += column * column
    lengths: FloatArray = np.sqrt(total, out=total)
    return lengths


def unwrapped_angles(angles: FloatArray) -> FloatArray:
    """Return angles (N,) rad without jumps of whole turns, as numpy's ``unwrap``."""
    found, turned = angles.copy(), 0.0
    for part in row_blocks(len(angles) - 1):
        after = angles[part.start + 1 : part.stop + 1]
        steps = after - angles[part]
        if (np.abs(steps) < math.pi).all():  # nearly always
            found[part.start + 1 : part.stop + 1] += turned
            continue
        turns = _whole_turns(steps)
        turns[0] += turned
        np.cumsum(turns, out=turns)
        found[part.start + 1 : part.stop + 1] += turns
        turned = float(turns[-1])
    return found


def _whole_turns(steps: FloatArray) -> FloatArray:
    """Return what is to be added (N,) rad to each of the steps."""
    nearest = np.mod(steps + math.pi, 2 * math.pi) - math.pi
    nearest[(nearest == -math.pi) & (steps > 0)] = math.pi
    turns: FloatArray = nearest - steps
    turns[np.abs(steps) < math.pi] = 0.0
    return turns
