"""Heading from the first strides: a gauge, fixed once for each foot (Ma & Särkkä 2023, IV-B)."""

from __future__ import annotations

import math

from .config import Heading
from .series import FloatArray

LEAST_WAY = 0.5  # m; a shorter way has no direction


class FirstStrides:
    """Collects one foot's stance positions until they give a direction."""

    def __init__(self, config: Heading) -> None:
        """Use ``config.from_stance`` and ``config.to_stance`` (stance 0 is the stand)."""
        self._config = config
        self._stances: list[FloatArray] = []

    @property
    def pivot(self) -> FloatArray:
        """Where the foot stood first (2,), m; undefined before the first stance."""
        return self._stances[0][:2].copy()

    def add(self, position: FloatArray) -> float | None:
        """Take the position (3,) m of the next stance; return the direction when it is known.

        A foot that has hardly moved (steps on the spot) waits for later stances.
        """
        self._stances.append(position)
        if len(self._stances) <= self._config.to_stance:
            return None
        way = position - self._stances[self._config.from_stance]
        if math.hypot(way[0], way[1]) < LEAST_WAY:
            return None
        return math.atan2(way[1], way[0])
