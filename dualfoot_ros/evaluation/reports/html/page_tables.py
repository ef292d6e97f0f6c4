"""Columns of numbers for the plots of a page: thinned, rounded and written as differences."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....core import FloatArray

MOST_ROWS = 8000
"""Rows of one table of a page: a plot has no more columns of pixels than that."""

MILLI = 0.001


def thin(count: int, most: int = MOST_ROWS) -> np.ndarray:
    """Return the (K,) rows to show of ``count``: evenly spaced, with the first and the last."""
    return np.unique(np.linspace(0, max(0, count - 1), min(count, most)).round().astype(int))


def column(values: FloatArray, unit: float = MILLI) -> dict[str, Any]:
    """Return (N,) values as multiples of ``unit``, each the difference to the one before.

    A value that is not finite is None, and is passed over by the differences.
    """
    values = np.asarray(values, dtype=np.float64)
    known = np.isfinite(values)
    whole = np.round(values[known] / unit).astype(np.int64)
    steps = iter(np.diff(whole, prepend=0).tolist())
    return {"unit": unit, "d": [next(steps) if good else None for good in known.tolist()]}


def table(columns: Mapping[str, FloatArray], units: Mapping[str, float] | None = None) -> Any:
    """Return several columns of equal length; ``units`` names those that are not thousandths."""
    given = units or {}
    return {name: column(values, given.get(name, MILLI)) for name, values in columns.items()}
