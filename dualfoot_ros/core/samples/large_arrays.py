"""Where large arrays of a walk are made: in memory, unless a program has another place for them.

An hour of 2 x 200 Hz takes 0.4 GB as a track.  A program for which that is too much gives a place
on disk (``recording.storage.file_arrays``); all arrays of a walk that grow with it are made here.
"""

from __future__ import annotations

import math
from contextvars import ContextVar
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

LARGE = 1 << 24  # bytes from which on an array is made in that place
Shape = tuple[int, ...]


class Place(Protocol):
    """Where large arrays are made, and what of them is in memory."""

    def new(self, shape: Shape, dtype: np.dtype[Any]) -> NDArray[Any]:
        """Return an array of zeros."""

    def rest(self) -> None:
        """Let go of what is in memory where that is much: a block of rows is done."""


_place: ContextVar[Place | None] = ContextVar("place", default=None)


def make_large_arrays_in(place: Place | None) -> None:
    """Make the large arrays of this program in ``place`` from now on; None is memory again."""
    _place.set(place)


def new_array(shape: Shape, dtype: Any = np.float64) -> NDArray[Any]:
    """Return a new array of zeros, in the place for large ones where it is one."""
    place, kind = _place.get(), np.dtype(dtype)
    if place is None or math.prod(shape) * kind.itemsize < LARGE:
        return np.zeros(shape, dtype=kind)
    return place.new(shape, kind)


def rest() -> None:
    """Tell the place of large arrays that a block of their rows is done."""
    place = _place.get()
    if place is not None:
        place.rest()


def placed(values: NDArray[Any]) -> NDArray[Any]:
    """Return values that are kept: themselves, or a copy in the place for large ones."""
    return values if _place.get() is None or values.nbytes < LARGE else _copy(values, values.dtype)


def contiguous(values: Any, dtype: Any) -> NDArray[Any]:
    """Return values as a C-contiguous array of a type: themselves where they are, or a copy."""
    array = np.asarray(values)
    if array.ndim == 0 or (array.dtype == np.dtype(dtype) and array.flags.c_contiguous):
        return np.ascontiguousarray(array, dtype=dtype)
    return _copy(array, dtype)


def _copy(array: NDArray[Any], dtype: Any) -> NDArray[Any]:
    copy = new_array(array.shape, dtype)
    copy[...] = array
    return copy
