"""The first standstill of a foot, and the mean readings of its sensor there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import AlignmentConfig, BoolArray, FloatArray, ImuSeries, stillness

AT_FIRST = 1 << 10  # windows looked at; then twice as many, where no standstill ends in them


@dataclass(frozen=True)
class Stand:
    """The first standstill of a foot.

    Attributes
    ----------
    start_s, end_s : s from the first sample of the foot
    windows : number of still windows
    specific_force : (3,) m/s^2, mean of the windows, the stiller ones counting more
    angular_rate : (3,) rad/s, mean in the same way: the gyro bias
    angular_rate_scatter : rad/s, greatest standard deviation of the windows' means
    """

    start_s: float
    end_s: float
    windows: int
    specific_force: FloatArray
    angular_rate: FloatArray
    angular_rate_scatter: float

    @property
    def duration_s(self) -> float:
        """Length of the standstill, s."""
        return self.end_s - self.start_s

    @property
    def gravity(self) -> float:
        """Norm of the mean specific force."""
        return float(np.linalg.norm(self.specific_force))


def first_stand(series: ImuSeries, config: AlignmentConfig | None = None) -> Stand | None:
    """Return the first run of still windows that lasts ``config.duration``, or None.

    Only the scatter within a window decides, not gravity: units may still be wrong.
    """
    config = config or AlignmentConfig()
    size = max(5, round(config.window * series.rate_hz)) if len(series) > 1 else 0
    if not size or len(series) < size:
        return None
    windows = len(series) // size
    force = series.specific_force[: windows * size].reshape(windows, size, 3)
    rate = series.angular_rate[: windows * size].reshape(windows, size, 3)
    needed = int(np.ceil(config.duration * series.rate_hz / size))
    run, still = None, np.zeros(0, dtype=bool)
    while len(still) < windows and (run is None or run[1] == len(still)):  # it may go on
        part = slice(len(still), max(AT_FIRST, 2 * len(still)))
        still = np.append(still, _are_still(force[part], rate[part], config))
        run = _first_run(still, needed)
    if run is None:
        return None
    used = slice(*run)
    weights = stillness(_scatter(rate[used]), config.still_rate_std)
    weights /= weights.sum()
    rates = rate[used].mean(axis=1)
    bias = weights @ rates
    seconds = (series.stamp_ns - series.stamp_ns[0]) * 1e-9
    return Stand(
        start_s=float(seconds[run[0] * size]),
        end_s=float(seconds[run[1] * size - 1]),
        windows=run[1] - run[0],
        specific_force=weights @ force[used].mean(axis=1),
        angular_rate=bias,
        angular_rate_scatter=float(np.sqrt(weights @ (rates - bias) ** 2).max()),
    )


def _are_still(force: FloatArray, rate: FloatArray, config: AlignmentConfig) -> BoolArray:
    """Return which windows (N, K, 3) are still."""
    still: BoolArray = (_scatter(rate) < config.max_rate_std) & (
        _scatter(force) < config.max_force_std
    )
    return still


def _scatter(windows: FloatArray) -> FloatArray:
    """Return the standard deviation (N,) within windows (N, K, 3), that of the worst axis."""
    worst: FloatArray = windows.std(axis=1).max(axis=1)
    return worst


def _first_run(still: np.ndarray, needed: int) -> tuple[int, int] | None:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], still.astype(np.int8), [0]))))
    for start, end in edges.reshape(-1, 2).tolist():
        if end - start >= max(1, needed):
            return start, end
    return None
