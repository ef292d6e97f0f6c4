"""Where an array of numpy has its parts, which the entries of a library read without its help."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

HEAD = object.__basicsize__  # bytes, of every object of Python
DATA, EXTENTS = HEAD, HEAD + 16  # where an array of numpy has its pointers
RANK, STRIDES, NUMBERS, FLAGS = HEAD + 8, HEAD + 24, HEAD + 40, HEAD + 48
TYPE, ALIGNED = HEAD - 8, 0x100  # of every object; among the flags


def knows_arrays() -> bool:
    """Return whether an array of numpy has all that is looked for in its place."""
    array = np.zeros((3, 5))

    def held(kind: type[Any], place: int) -> Any:
        return kind.from_address(id(array) + place).value

    pointers = [held(ctypes.c_void_p, place) for place in (DATA, TYPE, NUMBERS)]
    if pointers != [array.ctypes.data, id(np.ndarray), id(array.dtype)]:
        return False
    if (held(ctypes.c_int, RANK), held(ctypes.c_int, FLAGS)) != (2, array.flags.num):
        return False
    pairs = [held(ctypes.c_void_p, place) for place in (EXTENTS, STRIDES)]
    if None in pairs:
        return False
    found = [tuple((ctypes.c_int64 * 2).from_address(place)) for place in pairs]
    return found == [array.shape, array.strides]
