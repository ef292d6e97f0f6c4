"""What is known of a gyro bias before the walk."""

from __future__ import annotations

from typing import NamedTuple

from ..samples.series import FloatArray


class BiasPrior(NamedTuple):
    """A gyro bias (3,) rad/s and its standard deviation about each axis, rad/s."""

    mean: FloatArray
    std: float

    def combined(self, mean: FloatArray, std: float) -> tuple[FloatArray, float]:
        """Return bias and standard deviation when a standstill gave ``mean`` with ``std``."""
        own, other = self.std**-2, max(std, 1e-9) ** -2
        total = own + other
        combined: FloatArray = (own * self.mean + other * mean) / total
        return combined, float(total**-0.5)

    def also(self, other: BiasPrior | None) -> BiasPrior:
        """Return what this and another independent prior tell together."""
        return self if other is None else BiasPrior(*self.combined(other.mean, other.std))
