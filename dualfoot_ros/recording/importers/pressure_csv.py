"""A column of air pressure from a csv file: a time and a pressure, named with their units.

The first line names the columns.  The stamps must be of the same clock as those of the feet.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np

from ...core import FloatArray, PressureSeries, RecordingError

TIMES = {"stamp_ns": 1.0, "time_us": 1e3, "SampleTimeFine": 1e3, "time_ms": 1e6, "time_s": 1e9}
PRESSURES = {"pressure_Pa": 1.0, "pressure_hPa": 100.0, "pressure_mbar": 100.0}


def read_pressure(path: Path) -> PressureSeries:
    """Read a column of pressure.

    Raises
    ------
    RecordingError
        When the file has no such columns or a cell is no number; names file, column and line.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RecordingError(f"cannot read '{path}' as csv: {error}") from None
    if not rows:
        raise RecordingError(f"'{path}' holds no samples; expected a line of names, then numbers")
    _check_widths(path, rows)
    time, pressure = _find_column(path, rows[0], TIMES), _find_column(path, rows[0], PRESSURES)
    pascal = _column(path, rows, pressure) * PRESSURES[pressure]
    if time == "stamp_ns":  # nanoseconds of an epoch do not fit a float
        stamps = np.array([_integer(path, row[time], i) for i, row in enumerate(rows)])
    else:
        stamps = np.round(_column(path, rows, time) * TIMES[time]).astype(np.int64)
    return PressureSeries(stamps.astype(np.int64), pascal)


def _check_widths(path: Path, rows: list[dict[str, str]]) -> None:
    """Refuse rows with a cell too many or too few, which would be read shifted."""
    for i, row in enumerate(rows):
        extra: list[str] = dict[Any, Any](row).get(None, [])  # where DictReader puts the rest
        if "".join(extra).strip() or None in row.values():
            raise RecordingError(
                f"'{path}', line {i + 2}: not as many cells as the first line has names; which "
                "value belongs to which column is unknown, so export again or remove the row"
            )


def _find_column(path: Path, row: dict[str, str], names: dict[str, float]) -> str:
    present = [name for name in names if name in row]
    if len(present) != 1:
        raise RecordingError(
            f"'{path}' has the columns {', '.join(map(str, row))}; "
            f"exactly one must be one of {', '.join(names)}"
        )
    return present[0]


def _column(path: Path, rows: list[dict[str, str]], name: str) -> FloatArray:
    values = np.empty(len(rows))
    for i, row in enumerate(rows):
        try:
            values[i] = float(row[name])
        except (TypeError, ValueError):
            raise _no_number(path, name, row[name], i) from None
    return values


def _integer(path: Path, cell: str, row: int) -> int:
    try:
        return int(cell)
    except (TypeError, ValueError):
        raise _no_number(path, "stamp_ns", cell, row) from None


def _no_number(path: Path, name: str, cell: object, row: int) -> RecordingError:
    return RecordingError(f"'{path}', line {row + 2}: {name} is {cell!r}, which is no number")
