"""Cells of a table as numbers: damage is named, a cut last row left out, empty cells told."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....core import BoolArray, FloatArray, IntArray, RecordingError
from .dialect import MISSING, Dialect, split
from .raw_text import RawText

EXACT_DIGITS = 16  # a whole number with so many does not fit a float
TEXT_BYTES = 40  # of a cell that is text
BAD_ROWS = 200  # rows that are looked at one by one
TAIL_ROWS = 50  # rows with which the last one is compared
EMPTY = 1.7e308  # stands for an empty cell; no sensor reads it
WORDS = rb"(?i:n/?a|nan|null|none|#n/a|-+|\?)"


@dataclass(frozen=True)
class Body:
    """The rows of a table as bytes, with a dot for the decimal sign.

    Attributes
    ----------
    data : the whole rows
    dropped : the last row, which was cut, or ""
    """

    data: bytes
    dropped: str = ""


def read_body(raw: RawText, dialect: Dialect) -> Body:
    """Return the whole rows of the table.

    Raises
    ------
    RecordingError
        When rows have cells too many or too few, and would be read shifted.
    """
    data = raw.data[dialect.offset :].rstrip(b"\n ")
    if dialect.delimiter == " ":
        data = re.sub(rb"(?m)^ +| +$", b"", re.sub(rb"[ \t]+", b" ", data))
    data, dropped = _without_cut_row(data, raw, dialect)
    if dialect.names_offset >= 0:
        data = _without_repeated_names(data, raw, dialect)
    if not data.strip():
        raise RecordingError(f"'{raw.path}' holds no sample after its header; record again")
    _check_widths(data, raw, dialect)
    if dialect.decimal == ",":
        data = _with_dots(data, dialect)
    return Body(data, dropped)


def _without_cut_row(data: bytes, raw: RawText, dialect: Dialect) -> tuple[bytes, str]:
    """Return the rows without the last one if it was cut, and that one."""
    start = data.rfind(b"\n") + 1
    if start == 0:
        return data, ""
    last = data[start:].decode(raw.encoding, "replace")
    if len(split(last, dialect.delimiter)) >= dialect.named and (
        raw.ends_with_line or not _is_shorter(data[:start], last)
    ):
        return data, ""
    return data[: start - 1], last


def _is_shorter(before: bytes, last: str) -> bool:
    """Return whether the last number has fewer decimals than that of every row before."""
    rows = before.rsplit(b"\n", TAIL_ROWS)[1:]
    ends = [match[1] for row in rows if (match := re.search(rb"[.,](\d+)\s*$", row))]
    end = re.search(r"[.,](\d+)\s*$", last)
    usual = min((len(e) for e in ends), default=0)
    return len(ends) > 1 and (len(end[1]) if end else 0) < usual


def _without_repeated_names(data: bytes, raw: RawText, dialect: Dialect) -> bytes:
    """Leave out lines of names that stand again further down, as appended files have them."""
    start = dialect.names_offset
    line = raw.data[start : raw.data.find(b"\n", start)]
    return data.replace(line + b"\n", b"") if line in data else data


def _check_widths(data: bytes, raw: RawText, dialect: Dialect) -> None:
    """Refuse rows with a cell too many or too few."""
    delimiter = dialect.delimiter.encode()
    if b'"' in data:
        counts = [
            len(split(line, dialect.delimiter)) for line in data.decode("latin-1").split("\n")
        ]
        cells: NDArray[np.int64] = np.asarray(counts)
    else:
        cells = _count(data, delimiter)
    suspects = np.flatnonzero(cells != dialect.width)
    if not len(suspects):
        return
    rows = data.split(b"\n")
    bad = []
    for row in suspects[:BAD_ROWS].tolist():
        text = rows[row].decode(raw.encoding, "replace")
        found = split(text, dialect.delimiter)
        beyond = "".join(found[dialect.named :])
        if "".join(found) and (beyond or len(found) < dialect.named):
            bad.append((row, len(found)))
    if bad:
        row, count = bad[0]
        raise RecordingError(
            f"'{raw.path}' is damaged: line {dialect.first_line + row} has {count} cells where "
            f"the header names {dialect.named} columns (such rows: {len(bad)}); which value "
            "belongs to which column is unknown there, so export again or remove these rows"
        )


def _count(data: bytes, delimiter: bytes) -> NDArray[np.int64]:
    """Return the number of cells of each line."""
    signs = np.frombuffer(data, dtype=np.uint8)
    ends = np.append(np.flatnonzero(signs == ord("\n")), len(signs))
    before = np.searchsorted(np.flatnonzero(signs == ord(delimiter)), ends)
    counts: NDArray[np.int64] = np.diff(before, prepend=0) + 1
    return counts


def _with_dots(data: bytes, dialect: Dialect) -> bytes:
    """Return the rows with a dot for the decimal comma."""
    if dialect.delimiter != ",":
        return data.replace(b",", b".")
    return re.sub(rb'"([^"\n]*)"', lambda match: match[1].replace(b",", b"."), data)


@dataclass(frozen=True)
class Cells:
    """Numbers (N, K) of some columns; ``empty`` (N, K) are nan and were no numbers at all."""

    numbers: FloatArray
    empty: BoolArray


def read_numbers(body: Body, dialect: Dialect, places: Sequence[int], raw: RawText) -> Cells:
    """Return the numbers of the columns ``places``.

    Raises
    ------
    RecordingError
        When a cell is no number; names the column.
    """
    number = np.dtype(np.float64)
    try:
        numbers = _load(body.data, dialect, places, number)
        return Cells(numbers, np.zeros(numbers.shape, dtype=bool))
    except ValueError:
        pass
    try:
        numbers = _load(_repaired(body.data, dialect), dialect, places, number)
    except ValueError:
        raise _damage(raw, dialect, body.data, places) from None
    empty = numbers == EMPTY
    return Cells(np.where(empty, np.nan, numbers), empty)


def is_exact(cells: Sequence[str]) -> bool:
    """Return whether cells are whole numbers that a float does not hold."""
    return bool(cells) and all(cell.isdigit() and len(cell) >= EXACT_DIGITS for cell in cells)


def read_exact(body: Body, dialect: Dialect, place: int) -> IntArray | None:
    """Return (N,) whole numbers of a column that a float does not hold, or None."""
    if not is_exact([row[place] for row in dialect.sample]):
        return None
    try:
        return _load(body.data, dialect, [place], np.dtype(np.int64))[:, 0]
    except (ValueError, OverflowError):
        return None


def read_words(body: Body, dialect: Dialect, place: int, raw: RawText) -> list[str]:
    """Return the N cells of a column as text."""
    data = re.sub(_blank_lines(dialect), b"", body.data)
    try:
        cells = _load(data, dialect, [place], np.dtype(f"S{TEXT_BYTES}"))[:, 0]
    except ValueError:
        raise _damage(raw, dialect, body.data, ()) from None
    names = {cell: cell.decode(raw.encoding, "replace").strip() for cell in set(cells.tolist())}
    return [names[cell] for cell in cells.tolist()]


def _load(
    data: bytes, dialect: Dialect, places: Sequence[int], dtype: np.dtype[Any]
) -> NDArray[Any]:
    return np.loadtxt(
        io.BytesIO(data),
        dtype=dtype,
        delimiter=dialect.delimiter,
        usecols=list(places),
        quotechar='"',
        comments=None,
        encoding="latin-1",
        ndmin=2,
    )


def _blank_lines(dialect: Dialect) -> bytes:
    sign = re.escape(dialect.delimiter.encode())
    return rb'(?m)^(?:%b|[ \t"])*\n' % sign


def _repaired(data: bytes, dialect: Dialect) -> bytes:
    """Return the rows with EMPTY in empty cells, without rows of empty cells."""
    sign = re.escape(dialect.delimiter.encode())
    data = re.sub(_blank_lines(dialect), b"", data + b"\n").rstrip(b"\n")
    gap = rb" *" if dialect.delimiter == "\t" else rb"[ \t]*"
    word = rb'(?:"%b(?:%b)?%b"|(?:%b)?)' % (gap, WORDS, gap, WORDS)
    cell = rb"(?m)(?:(?<=%b)|^)%b%b%b(?=%b|$)" % (sign, gap, word, gap, sign)
    return re.sub(cell, repr(EMPTY).encode(), data)


def _damage(raw: RawText, dialect: Dialect, data: bytes, places: Sequence[int]) -> RecordingError:
    """Return the error that names the first cell of the columns that is no number."""
    for row, line in enumerate(data.decode(raw.encoding, "replace").split("\n")):
        cells = split(line, dialect.delimiter)
        for place in places if any(cells) else ():
            cell = cells[place] if place < len(cells) else ""
            if not _is_float(cell):
                name = (dialect.names[place] if dialect.names else "") or f"number {place + 1}"
                return RecordingError(
                    f"'{raw.path}' is damaged: line {dialect.first_line + row} has "
                    f"'{_shown(cell)}' in column '{name}', which is no number; correct the "
                    "cell, empty it or remove the row"
                )
    return RecordingError(
        f"'{raw.path}' is damaged: its rows from line {dialect.first_line} on cannot be read as "
        "numbers; export it again"
    )


def _shown(cell: str) -> str:
    """Return the start of a cell, with a mark for what cannot be printed."""
    return "".join(sign if sign.isprintable() else "\ufffd" for sign in cell[:TEXT_BYTES])


def _is_float(cell: str) -> bool:
    if cell.lower() in MISSING:
        return True
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
