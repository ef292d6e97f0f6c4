"""What the entries of the kernel take and return, for whatever compiles them."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

PREFIX = "dualfoot_"  # of the names of entries in a library


class Kind(StrEnum):
    """What a name of the kernel stands for; the value is how C declares it."""

    INTEGER = "int64_t"
    REAL = "double"
    INTEGERS = "int64_t *"
    REALS = "double *"
    ROWS = "Rows"  # an array of two dimensions
    SAMPLE = "double *const"  # an array from outside, of whatever kind: it is looked at first
    BYTES = "uint8_t *"

    @property
    def is_array(self) -> bool:
        """Whether it stands for many numbers."""
        return self not in {Kind.INTEGER, Kind.REAL}


class Entry(NamedTuple):
    """The kinds of an entry's parameters and of what it returns, if it does.

    One that takes a SAMPLE returns 0, and does nothing, when that is no array of 12 float64 that
    lie one after the other, or an integer beside it has more than 64 bits.
    """

    parameters: tuple[Kind, ...]
    result: Kind | None = None


_W, _N, _ROWS, _I, _X = Kind.REALS, Kind.INTEGERS, Kind.ROWS, Kind.INTEGER, Kind.REAL
_S = Kind.SAMPLE
_SAMPLES = (_ROWS,) * 4  # force and rate, left then right
_KEPT = (_ROWS, _ROWS, _ROWS, _X, _I, *(_ROWS,) * 7)  # what a trajectory keeps

ENTRY_KINDS = {
    "advance": Entry((_W, _N, _N, _N, *_SAMPLES, _I, _I, *_KEPT), _I),
    "keep": Entry((_W, _N, _I, *_KEPT)),
    "step": Entry((_W, _N, _N, _I, _X, _W, _ROWS), _I),
    "take_pair": Entry((_W, _N, _N, _I, _S, _ROWS), _I),
    "rerun": Entry((_W, _N, _I, _I)),
    "restore": Entry((_W, _N, _I)),
    "set_flags": Entry((_N, _I, _I, _I, _I)),
    "emit": Entry((_W, _N, _ROWS, _I)),
    "tell": Entry((_W, _ROWS), _I),
    "collect": Entry((_W, _I)),
    "correct": Entry((_W, _I), _X),
    "turn": Entry((_W, _I, _I, _X, _X, _W, _W)),
    "closest": Entry((_W, _X, _X)),
    "observe": Entry((_W, _W, _I, _I), _X),
    "constrain_spacing": Entry((_W, _W, _X, _X, _X, _X, _X, _I, _I), _X),
    "constrain_distance": Entry((_W, _W, _X, _X, _I, _I, _X, _X, _X), _I),
    "distance_after": Entry((_W, _W), _X),
    "learn_spacing": Entry((_W, _X, _X, _X, _X, _X, _X)),
    "end_stance": Entry((_W, _N, _W, _W, _W, _I, _X, _X, _X, _I), _I),
    "landing": Entry((_W, _N, _W, _I, _X), _X),
}
