"""The pairs before there is a track: the first tell the rate, all of them the standstill."""

from __future__ import annotations

import numpy as np

from .alignment import Standstill
from .config import TrackerConfig
from .samples.series import FloatArray

FIRST = 20  # pairs from which the rate is taken
RATES_HZ = (5.0, 5000.0)  # beyond these the stamps are wrong, and memory must stay bounded


class Opening:
    """Collects the pairs from the first one until both feet have stood long enough."""

    def __init__(self, config: TrackerConfig) -> None:
        """Start with nothing collected."""
        self._config = config
        self._first: list[tuple[int, FloatArray]] = []
        self.rate_hz = 0.0
        self.still: Standstill | None = None

    @property
    def complaint(self) -> str | None:
        """Why the last window was no standstill, if it was not."""
        return self.still.complaint if self.still else None

    def add(self, stamp: int, values: FloatArray) -> Standstill | None:
        """Take one pair; return the standstill when there is enough of it."""
        if self.still is not None:
            return self._enough(self.still, [values])
        self._first.append((stamp, values.copy()))
        if len(self._first) < FIRST:
            return None
        interval_ns = float(np.median(np.diff([s for s, _ in self._first])))
        self.rate_hz = float(np.clip(1e9 / max(1.0, interval_ns), *RATES_HZ))
        self.still = Standstill(self._config.alignment, self._config.gravity, self.rate_hz)
        return self._enough(self.still, [v for _, v in self._first])

    def _enough(self, still: Standstill, pairs: list[FloatArray]) -> Standstill | None:
        completed = [still.add(values) for values in pairs]
        return still if any(completed) and still.ready else None
