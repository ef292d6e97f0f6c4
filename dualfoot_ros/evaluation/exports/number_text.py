"""Text of many numbers at once, to the byte what Python's own formatting gives.

A file of an hour has millions of numbers, and one call for each takes most of the time of its
making.  Here a column of numbers becomes digits by arithmetic on the whole column.  A number that
lies so near to the middle between two texts that the product with a power of ten cannot tell which
is nearer is left to Python.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...core import BoolArray, FloatArray, IntArray

BLOCK = 1 << 14  # rows at once: what they need stays in the cache of the processor
LARGEST = 2.0**52  # beyond, a float has no digits behind the point
GROUP = 4  # digits that are looked up at once: as many as four bytes hold
DIGITS = np.frombuffer("".join(f"{k:04d}" for k in range(10**GROUP)).encode(), dtype=np.uint32)
MINUS, POINT, ZERO = b"-.0"
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
    doubtful = np.abs(np.abs(scaled - near) - 0.5) <= np.spacing(scaled)
    units = near.astype(np.int64)
    for k in np.flatnonzero(doubtful).tolist():
        units[k] = int(f"{abs(float(values[k])):.{decimals}f}".replace(".", ""))
    whole = units // 10**decimals
    fraction = units - whole * 10**decimals
    return Parts(np.signbit(values), whole, fraction, decimals)


def seconds(stamp_ns: IntArray) -> Parts:
    """Return stamps (N,) ns, not before 1970, in seconds with nine decimals."""
    whole, fraction = np.divmod(stamp_ns, 1_000_000_000)
    return Parts(np.zeros(len(whole), dtype=bool), whole, fraction, 9)


def integers(values: IntArray) -> Parts:
    """Return whole numbers (N,)."""
    return Parts(values < 0, np.abs(values), np.zeros_like(values), 0)


def lines(first: Parts, values: FloatArray, decimals: int, separator: str) -> Iterator[bytes]:
    """Yield the text of rows: ``first`` (N,), then ``values`` (N, K) with so many decimals."""
    for start in range(0, len(values), BLOCK):
        rows = slice(start, start + BLOCK)
        head = Parts(first.negative[rows], first.whole[rows], first.fraction[rows], first.decimals)
        parts = [fixed(column, decimals) for column in np.ascontiguousarray(values[rows].T)]
        known = [part for part in parts if part is not None]
        if len(known) == len(parts):
            yield _join([head, *known], separator)
        else:
            yield _one_by_one(head, values[rows], decimals, separator)


def _join(columns: Sequence[Parts], separator: str) -> bytes:
    """Return the text of columns side by side, a line for each row."""
    ends = [*[ord(separator)] * (len(columns) - 1), ord("\n")]
    pieces = [_text(column, end) for column, end in zip(columns, ends, strict=True)]
    text = np.hstack([characters for characters, _ in pieces])
    shown = np.hstack([mask for _, mask in pieces])
    return text[shown].tobytes()


def _text(parts: Parts, end: int) -> tuple[Bytes, BoolArray]:
    """Return characters (N, width) with ``end`` behind them, and which of them are shown."""
    count, decimals = len(parts.whole), parts.decimals
    groups = max(1, -(-len(str(int(parts.whole.max(initial=0)))) // GROUP))
    whole = _digits(parts.whole, groups)
    fraction = _digits(parts.fraction, -(-decimals // GROUP))
    width = 1 + whole.shape[1]
    text = np.empty((count, width + (1 + decimals if decimals else 0) + 1), dtype=np.uint8)
    shown = np.ones(text.shape, dtype=bool)
    text[:, 0], shown[:, 0] = MINUS, parts.negative
    text[:, 1:width] = whole
    for place in range(width - 2):  # a zero in front is shown only before the point
        shown[:, 1 + place] = parts.whole >= 10 ** (width - 2 - place)
    if decimals:
        text[:, width] = POINT
        text[:, width + 1 : -1] = fraction[:, fraction.shape[1] - decimals :]
    text[:, -1] = end
    return text, shown


def _digits(numbers: IntArray, groups: int) -> Bytes:
    """Return the last digits (N, groups * GROUP) of whole numbers (N,), zeros in front."""
    made = np.empty((len(numbers), groups), dtype=np.uint32)
    for k in range(groups - 1, -1, -1):
        rest = numbers // 10**GROUP  # quicker than divmod
        made[:, k] = DIGITS[numbers - rest * 10**GROUP]
        numbers = rest
    return made.view(np.uint8)


def _one_by_one(head: Parts, values: FloatArray, decimals: int, separator: str) -> bytes:
    """Return the text of rows of which a number is not finite, or too large."""
    first = _join([head], separator).decode().splitlines()
    rows = [[f"{value:.{decimals}f}" for value in row] for row in values.tolist()]
    pairs = zip(first, rows, strict=True)
    return "".join(separator.join([text, *row]) + "\n" for text, row in pairs).encode()
