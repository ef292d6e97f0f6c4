"""Arrival times of the samples of a bag: the log times of its messages."""

from __future__ import annotations

from pathlib import Path

from ..core import IntArray
from .read import read_logged
from .topics import Topics


def read_arrivals(path: str | Path, topics: Topics | None = None) -> dict[str, IntArray]:
    """Return the log times (N,) ns of the samples of each foot, in the order of `read_bag`.

    Raises
    ------
    RecordingError
        When the bag is not there, is no bag, or is damaged.
    """
    return read_logged(path, topics=topics)[1]
