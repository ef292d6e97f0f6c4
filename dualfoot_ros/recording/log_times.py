"""Arrival times of the samples of a bag: the log times of its messages."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core import FEET, IntArray
from .open_bag import opened
from .topics import Topics


def read_arrivals(path: str | Path, topics: Topics | None = None) -> dict[str, IntArray]:
    """Return the log times (N,) ns of the samples of each foot, in the order of `read_bag`.

    Raises
    ------
    RecordingError
        When the bag is not there, is no bag, or is damaged.
    """
    topics = topics or Topics()
    names = {topics.of(foot).imu: foot for foot in FEET}
    log_times: dict[str, list[int]] = {foot: [] for foot in FEET}
    with opened(Path(path)) as reader:
        wanted = [c for c in reader.connections if c.topic in names]
        for connection, log_ns, _ in reader.messages(wanted) if wanted else ():
            log_times[names[connection.topic]].append(log_ns)
    return {foot: np.array(times, dtype=np.int64) for foot, times in log_times.items()}
