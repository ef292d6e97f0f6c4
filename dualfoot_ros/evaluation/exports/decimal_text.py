"""Text of rows of numbers, one by one, in the part of Python that is compiled as the kernel is.

A number is rounded as Python rounds it: to the nearest text, and to the even one of two that are
as near.  Its product with a power of ten tells which that is, and where it lies in the middle,
what the product itself has lost in rounding.
"""

from __future__ import annotations

import math

from ...core import FloatArray, IntArray

PLACES, DECIMALS, SEPARATOR, ROWS, COLUMNS, ROOM = range(6)  # in `form`
LARGEST = 2.0**52  # beyond, a float has no digits behind the point
MIDDLE = 0.5
HALVES = 134217729.0  # 2^27 + 1, which cuts a float into two of 26 bits (Dekker)
NOT_NEGATIVE = 2**63 - 1  # the bits of numbers whose division needs no look at the sign
ZERO, MINUS, POINT, NEW_LINE = 48, 45, 46, 10


def write_rows(
    form: IntArray,
    power: float,
    stamps: IntArray,
    values: FloatArray,
    text: IntArray,
    digits: IntArray,
) -> int:
    """Write rows of a stamp and values at the end of ``text``; return where they begin.

    They are written from the last to the first, as digits come.  ``form`` holds PLACES (of a stamp
    behind the point), DECIMALS (of a value), SEPARATOR, ROWS, COLUMNS (of values), and the ROOM of
    the text; ``power`` is 10 to the power of DECIMALS.  -1 where a value is not finite, or too
    large.
    """
    at = int(form[ROOM])
    for below in range(form[ROWS]):
        row = form[ROWS] - 1 - below
        at -= 1
        text[at] = NEW_LINE
        for behind in range(form[COLUMNS]):
            value = values[row, form[COLUMNS] - 1 - behind]
            size = abs(value)
            if not size * power < LARGEST:
                return -1
            at = write_number(text, at, nearest(size, power), form[DECIMALS], digits)
            text[at - 1] = MINUS
            at -= int(math.copysign(1.0, value) < 0.0)  # else the separator takes its place
            at -= 1
            text[at] = form[SEPARATOR]
        at = write_number(text, at, stamps[row], form[PLACES], digits)
    return at


def write_number(text: IntArray, end: int, units: int, decimals: int, digits: IntArray) -> int:
    """Write a whole number before ``end`` with so many digits behind the point."""
    at, rest = end, units & NOT_NEGATIVE
    while end - at < decimals - 3:
        above = rest // 10000
        write_four(text, at, rest - 10000 * above, digits)
        at -= 4
        rest = above
    while end - at < decimals:
        above = rest // 10
        at -= 1
        text[at] = ZERO + rest - 10 * above
        rest = above
    if decimals > 0:
        at -= 1
        text[at] = POINT
    return write_whole(text, at, rest, digits)


def write_whole(text: IntArray, end: int, number: int, digits: IntArray) -> int:
    """Write all digits of a number before ``end``; at least one."""
    at, rest = end, number & NOT_NEGATIVE
    while rest > 9999:
        above = rest // 10000
        write_four(text, at, rest - 10000 * above, digits)
        at -= 4
        rest = above
    while rest > 9:
        above = rest // 10
        at -= 1
        text[at] = ZERO + rest - 10 * above
        rest = above
    text[at - 1] = ZERO + rest
    return at - 1


def write_four(text: IntArray, end: int, number: int, digits: IntArray) -> None:
    """Write the four digits of a number below 10000 before ``end``, as they are in the table."""
    at = 4 * number
    first, second, third, fourth = digits[at], digits[at + 1], digits[at + 2], digits[at + 3]
    text[end - 4] = first
    text[end - 3] = second
    text[end - 2] = third
    text[end - 1] = fourth


def nearest(size: float, power: float) -> int:
    """Return the whole number nearest to the product of two numbers, the even one of two."""
    product = size * power
    units = int(product)
    rest = product - units
    if rest == MIDDLE:
        lost = lost_of(size, power, product)
        if lost == 0.0:
            return units + (units & 1)
        return units + int(lost > 0.0)
    return units + int(rest > MIDDLE)


def lost_of(a: float, b: float, product: float) -> float:
    """Return what the rounded product of two numbers is short of them (Dekker)."""
    cut_a, cut_b = HALVES * a, HALVES * b
    upper_a, upper_b = cut_a - (cut_a - a), cut_b - (cut_b - b)
    lower_a, lower_b = a - upper_a, b - upper_b
    crossed = upper_a * lower_b + lower_a * upper_b
    return ((upper_a * upper_b - product) + crossed) + lower_a * lower_b
