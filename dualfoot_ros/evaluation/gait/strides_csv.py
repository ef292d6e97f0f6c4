"""Strides as a table for other programs: CSV, one row a stride."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from .strides import Stride

DIGITS = 6


def strides_csv(strides: Sequence[Stride]) -> str:
    """Return strides as CSV with a header; a cell is empty where a parameter is not known."""
    text = io.StringIO()
    names = [f.name for f in fields(Stride)]
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(getattr(stride, name)) for name in names] for stride in strides)
    return text.getvalue()


def _cell(value: Any) -> Any:
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, float):
        return f"{value:.{DIGITS}f}" if math.isfinite(value) else ""
    return value
