"""What is known of a gyro bias before the walk."""

from __future__ import annotations

from dataclasses import dataclass

from ..samples.series import FloatArray


@dataclass(frozen=True)
class BiasPrior:
    """A gyro bias (3,) rad/s and its standard deviation about each axis, rad/s."""

    mean: FloatArray
    std: float

    def combined(self, mean: FloatArray, std: float) -> tuple[FloatArray, float]:
        """Return bias and standard deviation when a standstill gave ``mean`` with ``std``."""
        own, other = self.std**-2, max(std, 1e-9) ** -2
        total = own + other
        combined: FloatArray = (own * self.mean + other * mean) / total
        return combined, float(total**-0.5)
