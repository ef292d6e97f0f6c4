"""One file of a table, opened: its form, the facts of its header, its layout, its cells."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ....core import BoolArray, FloatArray, IntArray, RecordingError
from .assumptions import Assumption, Origin
from .cells import Body, Cells, is_exact, read_body, read_exact, read_numbers, read_words
from .column_words import read_name
from .dialect import NAMES_OF_DELIMITERS, Dialect, find_dialect, is_number
from .known_layouts import recognise
from .raw_text import RawText, read_text
from .table_layout import Layout

RATE_KEYS = ("rate", "frequency", "fs", "frequenz")
DAY_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})(?=\D)")  # 31.5.2024, always in this order
CLOCK = re.compile(r"(?:(\d+)[:])?(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)")
DAY_S = 86400.0
LEAST_SAMPLES = 2


@dataclass(frozen=True)
class TableFile:
    """A table that was opened.

    Attributes
    ----------
    path : the file
    facts : key and value of the lines before the names
    layout : what the user gave, over the known layout, if it is one
    given, known : the two apart
    recognised : whether the table itself told its known layout
    """

    path: Path
    raw: RawText
    dialect: Dialect
    body: Body
    facts: Mapping[str, str]
    given: Layout
    known: Layout | None
    recognised: bool = False
    _read: dict[int, tuple[FloatArray, BoolArray]] = field(default_factory=dict, repr=False)

    @property
    def layout(self) -> Layout:
        """Everything that is known about the layout."""
        return self.given.over(self.known or Layout())

    def numbers(self, places: Sequence[int], also: Sequence[int] = ()) -> Cells:
        """Return (N, len(places)) numbers; ``also`` are read on the way, for later calls."""
        wanted = [place for place in dict.fromkeys([*places, *also]) if place not in self._read]
        if wanted:
            cells = read_numbers(self.body, self.dialect, wanted, self.raw)
            for column, place in enumerate(wanted):
                self._read[place] = (cells.numbers[:, column], cells.empty[:, column])
        numbers, empty = zip(*(self._read[place] for place in places), strict=True)
        return Cells(np.column_stack(numbers), np.column_stack(empty))

    def holds_numbers(self, place: int) -> bool:
        """Return whether a column holds numbers that a float holds exactly enough."""
        cells = [row[place] for row in self.dialect.sample]
        return any(is_number(cell, self.dialect.decimal) for cell in cells) and not is_exact(cells)

    def timed(self, place: int | None) -> BoolArray:
        """Return which rows have a time in ``place``; all, where none has or it is no number."""
        if place is None or not self.holds_numbers(place):
            return np.asarray(True)
        known = ~np.isnan(self.numbers([place]).numbers[:, 0])
        return known if known.any() else np.asarray(True)

    def words(self, place: int) -> list[str]:
        """Return N cells as text."""
        return read_words(self.body, self.dialect, place, self.raw)

    def time(self, place: int) -> tuple[FloatArray, IntArray | None]:
        """Return (N,) the time as numbers and, where a float does not hold it, as whole numbers.

        Dates are whole nanoseconds since 1970, clock times seconds since midnight.
        """
        cells = [row[place] for row in self.dialect.sample]
        if any(is_number(cell, self.dialect.decimal) for cell in cells) or not any(cells):
            exact = read_exact(self.body, self.dialect, place)
            values = (
                self.numbers([place]).numbers[:, 0] if exact is None else exact.astype(np.float64)
            )
            return values, exact
        return _from_dates(self.words(place), self.path, self.dialect.names[place])

    def check_filled(self, places: Sequence[int], keep: BoolArray) -> None:
        """Refuse the table with fewer than LEAST_SAMPLES rows to ``keep`` (N,).

        Raises
        ------
        RecordingError
            Naming how many there are, or the emptiest of the columns ``places``.
        """
        kept = int(keep.sum())
        if kept >= LEAST_SAMPLES:
            return
        gaps = self.numbers(places).empty.sum(axis=0)
        emptiest = int(np.argmax(gaps))
        if not gaps[emptiest]:
            raise RecordingError(
                f"'{self.path}' holds {len(keep)} sample{'' if len(keep) == 1 else 's'}; at least "
                f"{LEAST_SAMPLES} are needed"
            )
        names = self.dialect.names
        name = (names[places[emptiest]] if names else "") or "without name"
        raise RecordingError(
            f"'{self.path}' holds {kept} samples of which no cell is empty; column '{name}' is "
            f"empty in {gaps[emptiest]} of {len(keep)} rows: export it again, or name other "
            "columns with --columns"
        )

    def form(self, foot: str) -> list[Assumption]:
        """Return what was assumed about the text."""
        dialect, given = self.dialect, self.given
        told = Origin.OPTION if given.delimiter or given.decimal else Origin.VALUES
        text = (
            f"{NAMES_OF_DELIMITERS.get(dialect.delimiter, dialect.delimiter)} between cells, "
            f"decimal {'comma' if dialect.decimal == ',' else 'point'}, {self.raw.original}, "
            f"rows from line {dialect.first_line}"
        )
        found = [Assumption(foot, "text", f"{self.path.name}: {text}", told)]
        layout = self.known
        if layout is not None:
            about = f" ({layout.about})" if layout.about else " (of a layout file)"
            origin = Origin.NAME if self.recognised else Origin.OPTION
            found.append(Assumption(foot, "layout", f"{layout.name}{about}", origin))
        if self.body.dropped:
            dropped = f"left out, it was cut: '{self.body.dropped[:40]}'"
            found.append(Assumption(foot, "last row", dropped, Origin.VALUES, doubtful=True))
        return found


def open_table(path: Path, given: Layout, known: Layout | None = None) -> TableFile:
    """Open the table at ``path``; ``known`` is its layout where that is told.

    Raises
    ------
    RecordingError
        When it is no table, or damaged.
    OSError
        When it cannot be read.
    """
    raw = read_text(path)
    dialect = find_dialect(raw, given.over(known or Layout()))
    told = known is not None
    if known is None:
        plain = [read_name(name, k).plain for k, name in enumerate(dialect.names)]
        known = recognise(plain, dialect.preamble)
    return TableFile(
        path,
        raw,
        dialect,
        read_body(raw, dialect),
        header_facts(dialect.preamble, dialect.delimiter),
        given,
        known,
        recognised=not told,
    )


def header_facts(lines: Sequence[str], delimiter: str) -> dict[str, str]:
    """Return key and value of lines such as "OutputRate:,60Hz" and "// Update Rate: 100.0Hz"."""
    facts: dict[str, str] = {}
    for line in lines:
        plain = line.strip().strip('"').lstrip("/#% ")
        cells = [c.strip().strip('"') for c in plain.split(delimiter if delimiter != " " else ",")]
        for place, cell in enumerate(cells):
            key, colon, value = cell.partition(":")
            if not colon or not key.strip():
                continue
            value = value.strip() or (cells[place + 1] if place + 1 < len(cells) else "")
            facts.setdefault(key.strip(), value)
        if len(cells) > 1 and ":" not in cells[0] and "=" not in cells[0]:
            facts.setdefault(cells[0], cells[1])
        match = re.fullmatch(r"\s*([\w .]+?)\s*=\s*(.+?)\s*", plain)
        if match:
            facts.setdefault(match[1], match[2])
    return facts


def rate_in(facts: Mapping[str, str]) -> float | None:
    """Return the sampling rate, in Hz, that the header tells, or None."""
    for key, value in facts.items():
        if any(re.search(rf"{word}\b", key, re.I) for word in RATE_KEYS):
            match = re.match(r"\s*(\d+(?:\.\d+)?)\s*(?:hz|sps)?\s*$", value, re.I)
            if match and float(match[1]) > 0.0:
                return float(match[1])
    return None


def _from_dates(words: Sequence[str], path: Path, name: str) -> tuple[FloatArray, IntArray | None]:
    """Return the nanoseconds of dates since 1970, or the seconds of clock times since midnight.

    A clock time that begins anew is of the next day.
    """
    clock = [CLOCK.fullmatch(word) for word in words[:1]]
    try:
        if clock and clock[0]:
            return np.unwrap([_clock_s(word) for word in words], period=DAY_S), None
        plain = [_iso_date(word) for word in words]
        exact = np.array(plain, dtype="datetime64[ns]").astype(np.int64)
    except ValueError:
        raise RecordingError(
            f"'{path}': the time in column '{name}' is '{words[0]}', which is neither a number "
            "nor a date such as 2024-05-01T12:00:00.125; choose another column with --columns "
            "time=NAME, or give --rate HZ"
        ) from None
    return exact.astype(np.float64), exact


def _iso_date(word: str) -> str:
    """Return a date as numpy reads it."""
    plain = word.strip().rstrip("Z").replace("/", "-").replace(",", ".")
    plain = DAY_FIRST.sub(lambda m: f"{m[3]}-{int(m[2]):02d}-{int(m[1]):02d}", plain, count=1)
    return re.sub("[ T]+", "T", plain, count=1)


def _clock_s(word: str) -> float:
    match = CLOCK.fullmatch(word)
    if match is None:
        raise ValueError(word)
    hours, minutes, seconds = match.groups()
    return 3600.0 * int(hours or 0) + 60.0 * int(minutes) + float(seconds.replace(",", "."))
