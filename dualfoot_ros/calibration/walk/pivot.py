"""The pivot of the foot from loops and floor markers: height of the sensor above it, set-back.

A sensor that is taken to sit farther ahead of the pivot than it does sinks a little at every
stride, and one taken to sit higher makes longer strides.  So ``zupt.lever_back`` follows from the
height at which level loops end, and ``zupt.lever_arm`` from the length of a way between markers.
Both act linearly over the range that counts.  One pivot has to serve slow and fast walks.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core import FEET, FloatArray, TrackerConfig, Trajectory, stance_bounds
from ...evaluation import track
from ...recording import Recording, Reference
from ..sensor import SensorCalibration

STEP_M = 0.02  # of the derivatives
HEIGHT_STD_M = 0.02  # of a stride's height, m; grows with the square root of their number
LENGTH_STD = 0.005  # of a way between markers, relative
PRIOR_STD_M = 0.03
SPEEDS_APART = 1.2  # fastest over slowest walk that count as slow and fast


@dataclass(frozen=True)
class PivotFit:
    """The pivot that suits the walks.

    Attributes
    ----------
    lever_arm, lever_back : m, the parameters ``zupt.lever_arm`` and ``zupt.lever_back``
    lever_arm_std, lever_back_std : m
    heights_before, heights_after : m, at the end of each loop
    speeds : m/s, of each walk that counted
    lengths : number of ways between markers that counted
    """

    lever_arm: float
    lever_back: float
    lever_arm_std: float
    lever_back_std: float
    heights_before: tuple[float, ...]
    heights_after: tuple[float, ...]
    speeds: tuple[float, ...]
    lengths: int

    @property
    def paces(self) -> bool:
        """Whether slow and fast walks are among them."""
        return max(self.speeds) > SPEEDS_APART * min(self.speeds)

    def parameters(self) -> dict[str, float]:
        """Return the parameters of the tracker by dotted name."""
        found = {"zupt.lever_back": round(self.lever_back, 4)}
        if self.lengths:
            found["zupt.lever_arm"] = round(self.lever_arm, 4)
        return found


@dataclass(frozen=True)
class _Residuals:
    """Residuals of one walk in standard deviations: height, and length where there is one."""

    height_m: float
    strides: int
    speed: float
    length: float | None

    def scaled(self) -> list[float]:
        height = self.height_m / (HEIGHT_STD_M * math.sqrt(self.strides))
        return [height] if self.length is None else [height, self.length / LENGTH_STD]


def fit_pivot(
    recordings: Sequence[Recording],
    config: TrackerConfig,
    sensors: Mapping[str, SensorCalibration],
) -> PivotFit | None:
    """Return the pivot of the loops among ``recordings``, None when there is no loop."""
    loops = [
        (each.corrected(sensors), each.reference)
        for each in recordings
        if each.reference is not None and each.reference.closed_loop
    ]
    if not loops:
        return None
    base = np.array([config.zupt.lever_arm, config.zupt.lever_back])
    moved = (base, *(base + STEP_M * np.eye(2)))
    found = [[_residuals(loop, known, config, at) for loop, known in loops] for at in moved]
    now, arm, back = (np.array([v for r in each for v in r.scaled()]) for each in found)
    slopes = np.stack([arm - now, back - now], axis=1) / STEP_M
    change, stds = _solve(slopes, now, any(r.length is not None for r in found[0]))
    after = [
        r.height_m + (b.height_m - r.height_m) / STEP_M * change[1]
        + (a.height_m - r.height_m) / STEP_M * change[0]
        for r, a, b in zip(*found, strict=True)
    ]  # fmt: skip
    return PivotFit(
        float(base[0] + change[0]),
        float(base[1] + change[1]),
        *stds,
        tuple(r.height_m for r in found[0]),
        tuple(after),
        tuple(r.speed for r in found[0]),
        sum(r.length is not None for r in found[0]),
    )


def _solve(
    slopes: FloatArray, now: FloatArray, with_lengths: bool
) -> tuple[FloatArray, tuple[float, float]]:
    """Return the change (2,) m that brings residuals ``now`` (K,) to nought, and its deviations.

    Without lengths the first of the two, the height of the sensor, stays.
    """
    priors = np.array([PRIOR_STD_M if with_lengths else 1e-6, PRIOR_STD_M])
    known = slopes.T @ slopes + np.diag(priors**-2)
    change = np.asarray(-np.linalg.solve(known, slopes.T @ now), dtype=np.float64)
    left = now + slopes @ change
    scatter = max(1.0, float(left @ left) / max(1, len(now) - 2))
    stds = np.sqrt(scatter * np.diag(np.linalg.inv(known)))
    return change, (float(stds[0]), float(stds[1]))


def _residuals(
    recording: Recording, reference: Reference | None, config: TrackerConfig, at: FloatArray
) -> _Residuals:
    zupt = replace(config.zupt, lever_arm=float(at[0]), lever_back=float(at[1]))
    found = track(recording, replace(config, zupt=zupt))
    feet = found.left, found.right
    height = float(np.mean([foot.position[-1, 2] - foot.position[0, 2] for foot in feet]))
    strides = max(1, min(len(stance_bounds(foot.stance)) for foot in feet) - 1)
    moving = np.flatnonzero(~found.left.stance)
    stamps = found.left.stamp_ns[moving[[0, -1]]]
    speed = found.left.distance_m / (float(stamps[1] - stamps[0]) * 1e-9)
    return _Residuals(height, strides, speed, _length(found, reference))


def _length(found: Trajectory, reference: Reference | None) -> float | None:
    """Return by what share the way between the markers comes out too long, None without any."""
    shares = []
    for foot, points in (reference.markers if reference else {}).items():
        track_ = found.left if foot == FEET[0] else found.right
        true = float(np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1).sum())
        if len(stance_bounds(track_.stance)) == len(points) and true > 0.0:
            shares.append(track_.distance_m / true - 1.0)
    return float(np.mean(shares)) if shares else None
