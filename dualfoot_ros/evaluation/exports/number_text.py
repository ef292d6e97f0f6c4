"""Text of many numbers at once, to the byte what Python's own formatting gives.

A file of an hour has millions of numbers, and one call for each takes most of the time of its
making.  Here a column of numbers becomes digits by arithmetic on the whole column.  A number that
lies so near to the middle between two texts that the product with a power of ten cannot tell which
is nearer is left to Python.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...core import BoolArray, FloatArray, IntArray

BLOCK = 1 << 12  # rows at once: what they need stays in the cache of the processor
LARGEST = 2.0**52  # beyond, a float has no digits behind the point
GROUP = 4  # digits that are looked up at once: as many as four bytes hold
DIGITS = np.frombuffer("".join(f"{k:04d}" for k in range(10**GROUP)).encode(), dtype=np.uint32)
MINUS, POINT = np.frombuffer(b"-.", dtype=np.uint8)
NOTHING = b"\0"  # a place of a number that has fewer characters
Bytes = NDArray[np.uint8]


class Parts(NamedTuple):
    """Numbers (N,) in decimal: sign, whole part and ``decimals`` digits behind the point."""

    negative: BoolArray
    whole: IntArray
    fraction: IntArray
    decimals: int


def fixed(values: FloatArray, decimals: int) -> Parts | None:
    """Return ``values`` (N,) as ``f"{value:.{decimals}f}"`` has them; None where it is in vain.

    That is where one of them is not finite, or too large.
    """
    scaled = np.abs(values) * 10.0**decimals
    if not (scaled < LARGEST).all():
        return None
    near = np.rint(scaled)
    doubtful = np.abs(np.abs(scaled - near) - 0.5) <= np.spacing(scaled.max(initial=0.0))
    units = near.astype(np.int64)
    for k in np.flatnonzero(doubtful).tolist():
        units[k] = int(f"{abs(float(values[k])):.{decimals}f}".replace(".", ""))
    whole = units // 10**decimals
    fraction = units - whole * 10**decimals
    return Parts(np.signbit(values), whole, fraction, decimals)


def with_point(numbers: IntArray, decimals: int) -> Parts:
    """Return whole numbers (N,), not negative, with so many of their digits behind the point."""
    whole, fraction = np.divmod(numbers, 10**decimals)
    return Parts(np.zeros(len(whole), dtype=bool), whole, fraction, decimals)


def lines(first: Parts, values: FloatArray, decimals: int, separator: str) -> bytes:
    """Return the text of rows: ``first`` (N,), then ``values`` (N, K) with so many decimals."""
    parts = [fixed(column, decimals) for column in np.ascontiguousarray(values.T)]
    known = [part for part in parts if part is not None]
    if len(known) == len(parts):
        return _join([first, *known], separator)
    return _one_by_one(first, values, decimals, separator)


def _join(columns: Sequence[Parts], separator: str) -> bytes:
    """Return the text of columns side by side, a line for each row.

    They are written from the last to the first, since digits are looked up by the group: what a
    group has in front of the number is overwritten by what belongs there.
    """
    first, *others = [len(str(int(c.whole.max(initial=0)))) for c in columns]
    places = [-(-first // GROUP) * GROUP, *others]  # before the first number there is nothing
    ends = [*[ord(separator)] * (len(columns) - 1), ord("\n")]
    after = np.cumsum([_width(p, c) for p, c in zip(places, columns, strict=True)]).tolist()
    text = np.empty((len(columns[0].whole), after[-1]), dtype=np.uint8)
    for k in range(len(columns) - 1, -1, -1):
        text[:, after[k] - 1] = ends[k]
        _write(text[:, : after[k] - 1], columns[k], places[k])
    return text.tobytes().translate(None, NOTHING)  # quicker than a mask


def _width(places: int, parts: Parts) -> int:
    """Return how many characters a column needs, with its sign and what stands behind it."""
    return 1 + places + (1 + parts.decimals if parts.decimals else 0) + 1


def _write(text: Bytes, parts: Parts, places: int) -> None:
    """Write numbers with ``places`` before the point at the end of rows (N, width).

    Where there is no sign, and for zeros in front, there is NOTHING.
    """
    point = text.shape[1]
    if parts.decimals:
        _write_digits(text, parts.fraction.astype(np.uint32), parts.decimals)
        point -= 1 + parts.decimals
        text[:, point] = POINT
    _write_digits(text[:, :point], parts.whole, places)
    sign = point - places - 1
    text[:, sign] = MINUS * parts.negative
    for place in range(1, places - len(str(int(parts.whole.min(initial=LARGEST)))) + 1):
        text[:, sign + place] *= parts.whole >= 10 ** (places - place)


def _write_digits(text: Bytes, numbers: NDArray[np.integer], places: int) -> None:
    """Write the last digits of whole numbers (N,) at the end of rows, by whole groups."""
    base = numbers.dtype.type(10**GROUP)
    for end in range(text.shape[1], text.shape[1] - places, -GROUP):
        rest = numbers // base  # quicker than divmod
        text[:, end - GROUP : end].view(np.uint32)[:, 0] = DIGITS[numbers - rest * base]
        numbers = rest


def _one_by_one(head: Parts, values: FloatArray, decimals: int, separator: str) -> bytes:
    """Return the text of rows of which a number is not finite, or too large."""
    first = _join([head], separator).decode().splitlines()
    rows = [[f"{value:.{decimals}f}" for value in row] for row in values.tolist()]
    pairs = zip(first, rows, strict=True)
    return "".join(separator.join([text, *row]) + "\n" for text, row in pairs).encode()
