"""Layouts as YAML: what an import found or was told, kept for the next file of the kind."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ....core import FORCE_UNITS, RATE_UNITS, Increments, RecordingError
from .known_layouts import BY_NAME
from .table_layout import ROLES, Layout
from .unit_words import ARBITRARY, FIELD_UNITS, SAMPLES, TIME_UNITS

FORMAT = "dualfoot_layout"
VERSION = 1
KEYS = (
    *("format", "version", "name", "columns", "delimiter", "decimal", "skip", "time_unit", "rate"),
    *("force_unit", "rate_unit", "field_unit", "wrap_bits", "increments"),
)
CHOICES = {
    "time_unit": (*TIME_UNITS, SAMPLES),
    "force_unit": tuple(FORCE_UNITS),
    "rate_unit": tuple(RATE_UNITS),
    "field_unit": (*FIELD_UNITS, ARBITRARY),
    "increments": tuple(kind.value for kind in Increments),
}


def layout_text(layout: Layout) -> str:
    """Return a layout as YAML."""
    import yaml

    document = {
        "format": FORMAT,
        "version": VERSION,
        "name": layout.name,
        "columns": dict(layout.columns),
        "delimiter": layout.delimiter,
        "decimal": layout.decimal,
        "skip": layout.skip,
        "time_unit": layout.time_units[0] if layout.time_units else None,
        "rate": layout.rate_hz,
        "force_unit": layout.force_unit,
        "rate_unit": layout.rate_unit,
        "field_unit": layout.field_unit,
        "wrap_bits": layout.wrap_bits,
        "increments": None if layout.increments is None else layout.increments.value,
    }
    kept = {key: value for key, value in document.items() if value not in (None, {}, 0)}
    return yaml.safe_dump(kept, sort_keys=False, allow_unicode=True)


def load_layout(path: Path) -> Layout:
    """Read a layout.

    Raises
    ------
    RecordingError
        When it is no such file; names the key and what is allowed.
    OSError
        When it cannot be read.
    """
    import yaml

    try:
        document = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise RecordingError(f"'{path}' is no YAML: {' '.join(str(error).split())}") from None
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise RecordingError(f"'{path}' is no layout; allowed is a file with format: {FORMAT}")
    unknown = [str(key) for key in document if key not in KEYS]
    if unknown:
        raise RecordingError(f"'{path}' has the key '{unknown[0]}'; allowed are {', '.join(KEYS)}")
    _check(path, document)
    unit, kind = document.get("time_unit"), document.get("increments")
    name = str(document.get("name", "csv"))
    said = Layout(
        name=name,
        columns={str(role): str(name) for role, name in document.get("columns", {}).items()},
        delimiter=document.get("delimiter"),
        decimal=document.get("decimal"),
        skip=document.get("skip", 0),
        time_units=() if unit is None else (unit,),
        rate_hz=document.get("rate"),
        force_unit=document.get("force_unit"),
        rate_unit=document.get("rate_unit"),
        field_unit=document.get("field_unit"),
        wrap_bits=document.get("wrap_bits", 0),
        increments=None if kind is None else Increments(kind),
    )
    return said.over(BY_NAME.get(name, Layout()))


def _check(path: Path, document: dict[str, Any]) -> None:
    for key, allowed in CHOICES.items():
        _refuse_unless(path, key, document, document.get(key) in (None, *allowed), allowed)
    columns = document.get("columns", {})
    fine = isinstance(columns, dict) and all(role in ROLES for role in columns)
    _refuse_unless(path, "columns", document, fine, ROLES)
    for key in ("skip", "wrap_bits"):
        value = document.get(key, 0)
        fine = isinstance(value, int) and 0 <= value <= 62
        _refuse_unless(path, key, document, fine, ("a whole number from 0",))
    rate = document.get("rate")
    fine = rate is None or (isinstance(rate, (int, float)) and rate > 0)
    _refuse_unless(path, "rate", document, fine, ("a number of Hz",))
    for key, signs in (("delimiter", ",;|\t "), ("decimal", ".,")):
        value = document.get(key)
        fine = value is None or (isinstance(value, str) and len(value) == 1 and value in signs)
        _refuse_unless(path, key, document, fine, tuple(repr(sign) for sign in signs))


def _refuse_unless(
    path: Path, key: str, document: dict[str, Any], fine: bool, allowed: tuple[str, ...]
) -> None:
    if not fine:
        raise RecordingError(
            f"'{path}': {key} is '{document.get(key)}'; allowed is {', '.join(allowed)}"
        )
