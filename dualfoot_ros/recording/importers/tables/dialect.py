"""Delimiter, decimal sign, names and first row of a table, found from its first lines."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from ....core import RecordingError
from .raw_text import RawText
from .table_layout import Layout
from .unit_words import is_unit

DELIMITERS = ("\t", ";", ",", "|", " ")
NAMES_OF_DELIMITERS = {"\t": "tab", ";": "semicolon", ",": "comma", "|": "bar", " ": "space"}
SAMPLE = 60  # rows from which the form is found
NUMERIC_SHARE = 0.8  # of the rows, for a column of numbers
LIKE_DATA = 0.6  # of the columns of numbers, for a row of data
LEAST_COLUMNS = 2
MISSING = frozenset({"", "na", "n/a", "nan", "null", "none", "#n/a", "-", "--", "?"})
UNTIL_ROWS = 200  # lines in which the first row must stand


@dataclass(frozen=True)
class Dialect:
    """The form of a table.

    Attributes
    ----------
    delimiter, decimal : of the cells; a delimiter " " is any white space
    names : of the columns, as many as a row has cells; empty where there is none
    units : from a line of units below the names, empty where there is none
    preamble : lines before the names
    width : cells of a row
    first_line : number of the first row's line, from 1
    offset : byte at which the first row starts
    names_offset : byte at which the line of names starts, -1 without one
    """

    delimiter: str
    decimal: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    preamble: tuple[str, ...]
    width: int
    first_line: int
    offset: int
    names_offset: int
    sample: tuple[tuple[str, ...], ...] = ()

    @property
    def named(self) -> int:
        """Number of cells up to the last one that has a name."""
        return max((k for k, name in enumerate(self.names, start=1) if name), default=self.width)


def split(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line."""
    if delimiter == " ":
        if '"' not in line:
            return line.split()
        line = re.sub(r"[ \t]+", " ", line.strip())
    row = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    return [cell.strip() for cell in row]


def is_number(cell: str, decimal: str) -> bool:
    """Return whether a cell is a number with this decimal sign."""
    return _number(decimal).fullmatch(cell.strip()) is not None


@cache
def _number(decimal: str) -> re.Pattern[str]:
    """Return the pattern of a number: it is asked of every cell of the first lines."""
    sign = re.escape(decimal)
    after = r"\d+" if decimal == "," else r"\d*"  # "1," is a cell with a comma, "1." a number
    pattern = rf"[+-]?(\d+({sign}{after})?|{sign}\d+)([eE][+-]?\d+)?|[+-]?(nan|inf)"
    return re.compile(pattern, re.I)


def find_dialect(raw: RawText, layout: Layout) -> Dialect:
    """Return the form of the table in ``raw``; what ``layout`` says is taken.

    Raises
    ------
    RecordingError
        When there are no rows of numbers.
    """
    lines = raw.head()[layout.skip :]
    if len(lines) > 1 and (len(raw.data) > len("\n".join(lines)) or not lines[-1]):
        lines.pop()  # cut, or nothing after the last line feed
    body = [line for line in lines if line.strip()][-SAMPLE:]
    delimiter, decimal = _form(body, layout, _declared(lines))
    rows = [split(line, delimiter) for line in lines]
    width = _usual_width(rows, decimal)
    first = _first_row(rows, width, decimal)
    if first is None:
        raise RecordingError(
            f"'{raw.path}' holds no sample: no row of numbers was found in its first lines; give "
            "--delimiter, --decimal or --skip if it is a table"
        )
    names_at, units = _names_row(rows, first, decimal)
    names = () if names_at is None else tuple(rows[names_at])
    sample = tuple(tuple(row) for row in rows[first:][:SAMPLE] if len(row) == width)
    names = _fitted(names, width, sample, raw)
    skipped = layout.skip
    return Dialect(
        delimiter,
        decimal,
        names,
        tuple(_padded(units, width)),
        tuple(line for line in lines[: first if names_at is None else names_at] if line.strip()),
        width,
        skipped + first + 1,
        _offset(raw, skipped + first),
        -1 if names_at is None else _offset(raw, skipped + names_at),
        sample,
    )


def _declared(lines: Sequence[str]) -> str | None:
    """Return the delimiter that a first line "sep=;" declares."""
    match = re.fullmatch(r'"?sep=(.|\\t)"?\s*', lines[0], re.I) if lines else None
    if match is None:
        return None
    return "\t" if match[1] == "\\t" else match[1]


def _form(body: Sequence[str], layout: Layout, declared: str | None) -> tuple[str, str]:
    """Return delimiter and decimal sign with which most cells are numbers."""
    fixed = layout.delimiter or (declared if declared in DELIMITERS else None)
    delimiters = (fixed,) if fixed else DELIMITERS
    decimals = (layout.decimal,) if layout.decimal else (".", ",")
    forms = [(delimiter, decimal) for delimiter in delimiters for decimal in decimals]
    return max(forms, key=lambda form: _score(body, *form))  # of equal ones the first


def _score(body: Sequence[str], delimiter: str, decimal: str) -> int:
    """Return the number of numbers that a tenth of the rows have at least."""
    rows = [split(line, delimiter) for line in body]
    counts = sorted(sum(is_number(cell, decimal) for cell in row) for row in rows)
    return counts[-1 - len(counts) // 10] if counts else 0


def _usual_width(rows: Sequence[Sequence[str]], decimal: str) -> int:
    numeric = [len(row) for row in rows if _is_numeric(row, decimal)]
    widths = Counter(numeric or [len(row) for row in rows if row])
    return widths.most_common(1)[0][0] if widths else 0


def _is_numeric(row: Sequence[str], decimal: str) -> bool:
    """Return whether half of the cells that are not empty are numbers."""
    filled = [cell for cell in row if cell]
    return bool(filled) and 2 * sum(is_number(cell, decimal) for cell in filled) >= len(filled)


def _first_row(rows: Sequence[Sequence[str]], width: int, decimal: str) -> int | None:
    """Return the first row that has numbers where most rows have."""
    same = [row for row in rows if len(row) == width]
    usual = [row for row in same if _is_numeric(row, decimal)][-SAMPLE:] or same
    numeric = [
        column
        for column in range(width)
        if sum(_fits(row[column], decimal) for row in usual) >= NUMERIC_SHARE * len(usual)
        and any(is_number(row[column], decimal) for row in usual)
    ]
    if len(numeric) < LEAST_COLUMNS:
        return None
    for place, row in enumerate(rows[:UNTIL_ROWS]):
        if len(row) != width:
            continue
        numbers = sum(is_number(row[column], decimal) for column in numeric)
        fitting = sum(_fits(row[column], decimal) for column in numeric)
        if numbers >= LEAST_COLUMNS and fitting >= LIKE_DATA * len(numeric):
            return place
    return None


def _fits(cell: str, decimal: str) -> bool:
    return cell.lower() in MISSING or is_number(cell, decimal)


def _names_row(
    rows: Sequence[Sequence[str]], first: int, decimal: str
) -> tuple[int | None, Sequence[str]]:
    """Return the place of the row of names, and the row of units below it."""
    above = [place for place in range(first) if any(rows[place])]
    if not above:
        return None, ()
    last = above[-1]
    if len(above) > 1 and _are_units(rows[last]) and _are_names(rows[above[-2]], decimal):
        return above[-2], rows[last]
    return (last, ()) if _are_names(rows[last], decimal) else (None, ())


def _are_units(row: Sequence[str]) -> bool:
    filled = [cell for cell in row if cell]
    return len(filled) >= LEAST_COLUMNS and all(is_unit(cell) for cell in filled)


def _are_names(row: Sequence[str], decimal: str) -> bool:
    filled = [cell for cell in row if cell]
    texts = [cell for cell in filled if not is_number(cell, decimal)]
    return len(filled) >= LEAST_COLUMNS and 2 * len(texts) > len(filled)


def _fitted(
    names: Sequence[str], width: int, sample: Sequence[Sequence[str]], raw: RawText
) -> tuple[str, ...]:
    """Return as many names as a row has cells."""
    names = list(names)
    while names and not names[-1] and len(names) > width:
        names.pop()
    surplus = width - len(names)
    if not names or surplus == 0:
        return tuple(_padded(names, width))
    if surplus > 0 and not any("".join(row[len(names) :]) for row in sample):
        return tuple(_padded(names, width))  # delimiters at the end of each row
    if surplus == 1 and _counts_up([row[0] for row in sample]):
        return ("", *names)  # an index without a name, as data frames write it
    raise RecordingError(
        f"'{raw.path}' is damaged: its rows have {width} cells where the header names "
        f"{len(names)} columns, so which value belongs to which column is unknown; export again, "
        "or name the columns by number with --columns and leave the header out with --skip"
    )


def _counts_up(cells: Sequence[str]) -> bool:
    if not all(cell.isdigit() for cell in cells):
        return False
    numbers = [int(cell) for cell in cells]
    return numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def _padded(cells: Sequence[str], width: int) -> list[str]:
    return [*cells, *[""] * (width - len(cells))]


def _offset(raw: RawText, lines: int) -> int:
    """Return the byte at which line ``lines`` (from 0) starts."""
    at = 0
    for _ in range(lines):
        at = raw.data.find(b"\n", at) + 1
    return at
