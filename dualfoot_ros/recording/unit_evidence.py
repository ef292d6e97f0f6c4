"""What the motion itself says about units: gravity in quiet moments, and bounds on the rates.

Gravity is 9.8 m/s^2 whatever the name of a column says.  The rates of a foot obey bounds: a
walking foot turns with 3 to 12 rad/s; a sensor at rest reads its bias only; and between two quiet
moments gravity cannot have turned farther than the rates add up to.  The units of rates are
factors of 57 apart or more, so bounds decide, wherever there is motion enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..core import STANDARD_GRAVITY, BoolArray, FloatArray, ImuSeries, IntArray

BLOCK_S = 0.08  # in which a moment is quiet or not
LEAST_SAMPLES = 3  # of a block
LEAST_BLOCKS = 12
QUIET = 0.02  # scatter of the force in a quiet block, of its mean
NEAR_GRAVITY = 0.04  # a quiet block reads gravity, within
QUIET_SHARE = 0.3  # quantile of the scatter: the quietest blocks give gravity

WALKING = 0.4  # 95 % quantile of the force's difference from gravity, over gravity
FASTEST = 40.0  # rad/s, 98 % quantile of any foot (2300 deg/s is the end of any range)
SLOWEST_WALK = 0.9  # rad/s, 98 % quantile of a foot that walks; bounds are less than 57 apart
LARGEST_BIAS = 0.35  # rad/s, at rest
LEAST_ANGLE = 0.35  # rad, of gravity between quiet moments; less shows nothing
TURN_MARGIN = 3.0  # times the sum of the rates
GRAVITY_ERROR = 0.2  # of the gravity, for a unit of the force to be believed


@dataclass(frozen=True)
class UnitEvidence:
    """The motion of one sensor, in the units of its file.

    Attributes
    ----------
    gravity : norm of the force in quiet moments, or its median where there are none
    quiet : whether there are quiet moments
    swing : 95 % quantile of the difference between force and gravity, over gravity
    high_rate : 98 % quantile of the norm of the rate
    rest_rate : median norm of the rate in quiet moments, nan without one
    turn_ratio : greatest turn of gravity between quiet moments, in rad, over the sum of the rates
    """

    gravity: float
    quiet: bool
    swing: float
    high_rate: float
    rest_rate: float
    turn_ratio: float

    @property
    def walks(self) -> bool:
        """Whether the forces are those of a foot that walks."""
        return self.swing > WALKING

    def rate_fits(self, size: float) -> bool:
        """Return whether the rates can be in a unit of ``size`` rad/s."""
        high, rest = self.high_rate * size, self.rest_rate * size
        too_fast = high > FASTEST or rest > LARGEST_BIAS
        too_slow = (self.walks and high < SLOWEST_WALK) or self.turn_ratio / size > TURN_MARGIN
        return not (too_fast or too_slow)

    def rate_unit(self, sizes: Mapping[str, float]) -> str | None:
        """Return the only unit of ``sizes`` (in rad/s) that is possible, or None."""
        fitting = [unit for unit, size in sizes.items() if self.rate_fits(size)]
        return fitting[0] if len(fitting) == 1 else None

    def force_fits(self, size: float) -> bool:
        """Return whether gravity is 9.8 m/s^2 in a unit of ``size`` m/s^2."""
        return abs(self.gravity * size / STANDARD_GRAVITY - 1.0) < GRAVITY_ERROR

    def force_unit(self, sizes: Mapping[str, float]) -> str | None:
        """Return the only unit of ``sizes`` (in m/s^2) in which gravity is right, or None."""
        fitting = [unit for unit, size in sizes.items() if self.force_fits(size)]
        return fitting[0] if len(fitting) == 1 else None


def evidence_of(series: ImuSeries) -> UnitEvidence:
    """Return what the motion of a recording says about its units."""
    return unit_evidence(series.stamp_ns, series.specific_force, series.angular_rate)


def unit_evidence(stamp_ns: IntArray, force: FloatArray, rate: FloatArray) -> UnitEvidence:
    """Return what the motion says; ``force`` and ``rate`` are (N, 3) in any unit."""
    good = np.isfinite(force).all(axis=1) & np.isfinite(rate).all(axis=1)
    stamp_ns, force, rate = stamp_ns[good], force[good], rate[good]
    if not len(stamp_ns):
        return UnitEvidence(np.nan, False, 0.0, 0.0, np.nan, 0.0)
    norm, speed = np.linalg.norm(force, axis=1), np.linalg.norm(rate, axis=1)
    interval = _interval_s(stamp_ns)
    size = max(LEAST_SAMPLES, round(BLOCK_S / interval)) if interval > 0 else LEAST_SAMPLES
    blocks = len(norm) // size
    cut = blocks * size
    mean, gravity, still = _quiet_blocks(force[:cut].reshape(blocks, size, 3), norm)
    sums = speed[:cut].reshape(blocks, size).sum(axis=1) * interval
    block_s = size * interval
    known = still.any() and block_s > 0.0
    rest = float(np.median(sums[still])) / block_s if known else np.nan
    return UnitEvidence(
        gravity,
        bool(still.any()),
        float(np.quantile(np.abs(norm / gravity - 1.0), 0.95)) if gravity > 0 else 0.0,
        float(np.quantile(speed, 0.98)),
        rest,
        _turn_ratio(mean[still], np.cumsum(sums)[still], block_s),
    )


def _interval_s(stamp_ns: IntArray) -> float:
    steps = np.diff(stamp_ns)
    steps = steps[steps > 0]
    return float(np.median(steps)) * 1e-9 if len(steps) else 0.0


def _quiet_blocks(blocks: FloatArray, norm: FloatArray) -> tuple[FloatArray, float, BoolArray]:
    """Return the mean of each block, gravity, and which blocks are quiet."""
    mean = blocks.mean(axis=1) if len(blocks) else np.empty((0, 3))
    none = np.zeros(len(mean), dtype=bool)
    size = np.linalg.norm(mean, axis=1)
    if len(mean) < LEAST_BLOCKS:
        return mean, float(np.median(norm)), none
    scatter = blocks.std(axis=1).max(axis=1)
    quietest = scatter <= np.quantile(scatter, QUIET_SHARE)
    gravity = float(np.median(size[quietest]))
    still = (scatter < QUIET * gravity) & (np.abs(size - gravity) < NEAR_GRAVITY * gravity)
    return mean, gravity if still.any() else float(np.median(norm)), still


def _turn_ratio(mean: FloatArray, angle: FloatArray, block_s: float) -> float:
    """Return the greatest turn of gravity from one quiet block to the next over the rates' sum."""
    if len(mean) < LEAST_SAMPLES or block_s <= 0.0:
        return 0.0
    unit = mean / np.linalg.norm(mean, axis=1)[:, None]
    cosine = np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0)
    turned = np.arccos(cosine)
    far = turned > LEAST_ANGLE
    if not far.any():
        return 0.0
    summed = np.maximum(np.diff(angle)[far], np.finfo(float).tiny)
    return float(np.median(turned[far] / summed))
