"""Strides as a table for other programs: CSV, one row a stride."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import asdict, fields
from typing import Any

from .strides import Stride

DIGITS = 6


def strides_csv(strides: Sequence[Stride]) -> str:
    """Return strides as CSV with a header; a cell is empty where a parameter is not known."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [f.name for f in fields(Stride)], lineterminator="\n")
    writer.writeheader()
    for stride in strides:
        writer.writerow({name: _cell(value) for name, value in asdict(stride).items()})
    return text.getvalue()


def _cell(value: Any) -> Any:
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, float):
        return f"{value:.{DIGITS}f}" if math.isfinite(value) else ""
    return value
