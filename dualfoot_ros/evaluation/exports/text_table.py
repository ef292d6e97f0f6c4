"""Long tables of numbers as text: compiled where there is a C compiler, else with numpy."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import BinaryIO, NamedTuple

import numpy as np

from ...core import FloatArray, IntArray
from ...core.compiler import Entry, Functions, Kind, compiled_module
from . import decimal_text
from .number_text import BLOCK, DIGITS, lines, with_point

MANY = 1 << 16  # rows of a table for which a library is made, which takes half a second once
WIDEST = 32  # characters of a number of less than 2^63 with all that goes with it
ENTRIES = {
    "write_rows": Entry(
        (Kind.INTEGERS, Kind.REAL, Kind.INTEGERS, Kind.ROWS, Kind.BYTES, Kind.BYTES),
        Kind.INTEGER,
    )
}


class Form(NamedTuple):
    """How a table is written: digits behind the point of stamps and of values, what separates."""

    places: int
    decimals: int
    separator: str


def write_table(
    file: BinaryIO, stamps: IntArray, values_of: Callable[[slice], FloatArray], form: Form
) -> None:
    """Write a line for each of the stamps (N,), not negative, followed by its values.

    ``values_of`` returns those of some rows (M, K).
    """
    library = compiled_text() if len(stamps) >= MANY else None
    for first in range(0, len(stamps), BLOCK):
        rows = slice(first, first + BLOCK)
        own, values = stamps[rows], np.ascontiguousarray(values_of(rows))
        text = None if library is None else text_of(library, own, values, form)
        file.write(
            lines(with_point(own, form.places), values, *form[1:]) if text is None else text
        )


@cache
def compiled_text() -> Functions | None:
    """Return the compiled functions; None where there are none."""
    return compiled_module(decimal_text, ENTRIES, _same_text)


def text_of(
    functions: Functions, stamps: IntArray, values: FloatArray, form: Form
) -> memoryview | None:
    """Return the lines of some rows; None where a value is not finite, or too large."""
    count, columns = values.shape
    text = np.empty(count * (columns + 1) * WIDEST, dtype=np.uint8)
    numbers = np.array([*form[:2], ord(form.separator), count, columns, len(text)])
    stamps = np.ascontiguousarray(stamps)
    given = stamps, values, text, DIGITS.view(np.uint8)
    begin = functions["write_rows"](numbers, 10.0**form.decimals, *given)
    return None if begin < 0 else text[begin:].data


def _same_text(functions: Functions) -> bool:
    """Return whether the compiled functions write what the same functions in Python write."""
    values = np.linspace(-70.0, 70.0, 140)[:, np.newaxis] * 10.0 ** np.arange(-9, 3, 3)
    values[:, 0] = np.arange(140) / 2**7  # in the middle of two texts
    stamps = 10**18 + 12345678 * np.arange(140)
    plain: Functions = dict(vars(decimal_text))
    forms = Form(9, 6, " "), Form(0, 9, ",")
    return all(
        text_of(functions, stamps, values, f) == text_of(plain, stamps, values, f) for f in forms
    )
