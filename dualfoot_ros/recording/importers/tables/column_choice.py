"""The column of each role: by options, by the layout, or by names; what is missing is named."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ....core import RecordingError
from .column_words import TIMES, ColumnName, read_name
from .dialect import MISSING, Dialect, is_number
from .table_layout import ROLES, VECTORS, Layout

PRESENT = (
    ("quaternions", re.compile(r"quat|^q[0-3wxyz]$")),
    ("Euler angles", re.compile(r"euler|roll|pitch|yaw")),
    ("free acceleration (gravity taken out)", re.compile(r"free ?acc|linear ?acc|user ?acc")),
    ("acceleration", re.compile(r"^acc|^accel")),
    ("angular rates", re.compile(r"gyr|omega|angular vel")),
    ("a magnetic field", re.compile(r"\bmag")),
)
PARTS = {"specific force": "acceleration", "angular rate": "angular rates"}
MOST_NAMES = 12  # of columns in a sentence


@dataclass(frozen=True)
class Columns:
    """The columns of one sensor.

    ``places`` has the number of the column (from 0) of each role; ``names`` what its name says.
    ``given`` are the roles that options or the layout set.
    """

    places: Mapping[str, int]
    names: Mapping[str, ColumnName]
    given: frozenset[str]
    side: str = ""

    def vector(self, quantity: str) -> list[int] | None:
        """Return the columns of "force", "rate" ..., or None when one is missing."""
        roles = VECTORS[quantity]
        return [self.places[r] for r in roles] if all(r in self.places for r in roles) else None

    def unit(self, role: str) -> str | None:
        """Return the unit that the name of the column of ``role`` tells."""
        name = self.names.get(role)
        return None if name is None else name.unit

    def foreign(self, role: str) -> ColumnName | None:
        """Return the name of the column of ``role`` if it tells a unit that is not known."""
        name = self.names.get(role)
        return name if name is not None and name.foreign else None


def read_names(dialect: Dialect, assumed: str = "") -> list[ColumnName]:
    """Return what the names of the columns say."""
    units = (*dialect.units, *[""] * dialect.width)
    return [read_name(text, k, units[k], assumed) for k, text in enumerate(dialect.names)]


def choose_columns(
    path: Path, dialect: Dialect, layout: Layout, assumed: str = ""
) -> list[Columns]:
    """Return the columns of each sensor in the table: one, or those of both feet side by side.

    Raises
    ------
    RecordingError
        When a column that was named is not there, or several could be meant.
    """
    names = read_names(dialect, assumed)
    given = {role: _place(path, dialect, names, text) for role, text in layout.columns.items()}
    taken = set(given.values())
    free = [name for name in names if name.place not in taken]
    sides = {name.side for name in free if name.kind in ("force", "rate")} - {""}
    if sides == {"left", "right"}:
        return [_of_one(path, dialect, layout, given, free, side) for side in ("left", "right")]
    plain = [replace(name, side="") for name in free]
    return [_of_one(path, dialect, layout, given, plain, "")]


def _of_one(
    path: Path,
    dialect: Dialect,
    layout: Layout,
    given: Mapping[str, int],
    names: Sequence[ColumnName],
    side: str,
) -> Columns:
    places = dict(given)
    own = [name for name in names if name.side in ("", side)]
    for quantity, roles in VECTORS.items():
        if not any(role in places for role in roles):
            group = _group(path, quantity, [n for n in own if n.kind == quantity], layout)
            places |= dict(zip(roles, group, strict=True)) if group else {}
    for role, chosen in (
        ("time", _time(own, dialect)),
        ("counter", _counter(own, dialect, layout)),
        ("device", next((n.place for n in own if n.kind == "device"), None)),
    ):
        if role not in places and chosen is not None:
            places[role] = chosen
    by_place = {name.place: name for name in read_names(dialect)}
    by_place |= {name.place: name for name in names}
    found = {role: by_place[place] for role, place in places.items() if place in by_place}
    return Columns(places, found, frozenset(given), side)


def _place(path: Path, dialect: Dialect, names: Sequence[ColumnName], text: str) -> int:
    """Return the column that is meant by a name, or by its number from 1."""
    lower, joined = text.lower(), re.sub(r"[^0-9a-z]", "", text.lower())
    spellings = (
        [name.text == text for name in names],
        [name.text.lower() == lower for name in names],
        [name.plain == lower for name in names],
        [name.plain.replace(" ", "") == joined for name in names],
    )
    for same in spellings:
        if sum(same) == 1:
            return names[same.index(True)].place
    if text.isdigit() and 1 <= int(text) <= dialect.width:
        return int(text) - 1
    known = ", ".join(f"'{name}'" for name in dialect.names if name) or "none has a name"
    raise RecordingError(
        f"'{path}' has no column '{text}' (or several); its {dialect.width} columns are: {known}; "
        "allowed are their names, and numbers from 1"
    )


def _group(
    path: Path, quantity: str, names: Sequence[ColumnName], layout: Layout
) -> list[int] | None:
    """Return the columns of the one complete vector of a quantity, or None."""
    axes = "wxyz" if quantity == "turn" else "xyz"
    groups: dict[tuple[object, ...], dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
    for name in names:
        groups[(name.free, name.words)][name.axis].append(name.place)
    whole = {key: g for key, g in groups.items() if all(axis in g for axis in axes)}
    with_gravity = {key: g for key, g in whole.items() if not key[0]}
    whole = with_gravity or whole
    for word in layout.prefer:
        whole = {key: g for key, g in whole.items() if word in str(key[1]).split("'")} or whole
    if not whole:
        return None
    single = next(iter(whole.values()))
    if len(whole) > 1 or any(len(single[axis]) > 1 for axis in axes):
        shown = [name.text for name in names][:MOST_NAMES]
        raise RecordingError(
            f"'{path}' has several columns of the {quantity}: {', '.join(shown)}; choose three "
            f"with --columns {','.join(f'{role}=NAME' for role in VECTORS[quantity])}"
        )
    return [single[axis][0] for axis in axes]


def _filled(place: int, dialect: Dialect) -> bool:
    return any(row[place].lower() not in MISSING for row in dialect.sample)


def _numeric(place: int, dialect: Dialect) -> bool:
    return any(is_number(row[place], dialect.decimal) for row in dialect.sample)


def _time(names: Sequence[ColumnName], dialect: Dialect) -> int | None:
    """Return the column of the time: one of numbers before one of dates, a usual name before."""
    times = [n for n in names if n.kind == "time" and _filled(n.place, dialect)]
    first = {word: rank for rank, word in enumerate(TIMES)}

    def rank(name: ColumnName) -> tuple[bool, bool, int]:
        words = [first[w] for w in name.plain.split() if w in first]
        joined = first.get(name.plain.replace(" ", ""), len(first))
        return not _numeric(name.place, dialect), bool(name.words), min([joined, *words])

    return min(times, key=rank).place if times else None


def _counter(names: Sequence[ColumnName], dialect: Dialect, layout: Layout) -> int | None:
    if not layout.counts_samples:
        return None
    found = [n for n in names if n.kind == "counter" and not n.axis and _numeric(n.place, dialect)]
    return found[0].place if found else None


def missing(path: Path, dialect: Dialect, columns: Columns, facts: Mapping[str, str]) -> str:
    """Return the sentence that names what a table lacks, and what it has."""
    if not any(dialect.names):
        return (
            f"'{path}' has no line with the names of its {dialect.width} columns; give their "
            "numbers, from 1, as in --columns time=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7"
        )
    lacks = [
        word
        for word, roles in (
            ("specific force", ("force", "push")),
            ("angular rate", ("rate", "turn")),
        )
        if not any(columns.vector(role) for role in roles)
    ]
    plain = [name.plain for name in read_names(dialect)]
    has = [word for word, pattern in PRESENT if any(pattern.search(text) for text in plain)]
    mode = next((value for key, value in facts.items() if "mode" in key.lower()), "")
    in_part = any(PARTS[word] in has for word in lacks)  # two axes of a rate are no rate
    held = (
        " and ".join(has) + " only" if has and not in_part else f"the columns {_listed(dialect)}"
    )
    return (
        f"'{path}'{f' (mode {mode})' if mode else ''} has no {' and no '.join(lacks)}: it holds "
        f"{held}; record or export the quantities of the sensor itself (acceleration with "
        "gravity, angular rate), or name their columns with --columns ax=...,gx=..."
    )


def _listed(dialect: Dialect) -> str:
    names = [f"'{name}'" for name in dialect.names if name][:MOST_NAMES]
    return ", ".join(names)


def parse_columns(text: str) -> dict[str, str]:
    """Return role and column of "time=t,ax=Acc X,..."; names may hold commas.

    Raises
    ------
    RecordingError
        When a role is unknown.
    """
    pairs = re.findall(r"\s*(\w+)\s*=\s*(.*?)\s*(?:,(?=\s*\w+\s*=)|$)", text)
    unknown = [role for role, _ in pairs if role not in ROLES]
    if unknown or not pairs:
        raise RecordingError(
            f"--columns is '{text}'; allowed is ROLE=COLUMN,... with ROLE one of "
            f"{', '.join(ROLES)}"
        )
    return dict(pairs)
