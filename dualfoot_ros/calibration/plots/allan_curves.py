"""Allan deviation of gyro and accelerometer, with the slopes that were read off it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...core import FloatArray
from ...evaluation.reports.plots import FOOT, GREEN, MARKER, TRUTH, new_figure, save
from ..allan import FLOOR, AllanCurve, Slopes
from ..gyro import UNITS, GyroFit

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AXIS = (FOOT["left"], FOOT["right"], GREEN)


def draw_allan(fits: Mapping[str, GyroFit], path: Path) -> Path:
    """Draw the Allan deviation, one row a sensor, gyro beside accelerometer, slopes marked."""
    figure, axes = new_figure(11.0, 0.6 + 4.2 * len(fits), rows=len(fits), columns=2)
    for row, (name, fit) in zip(axes, fits.items(), strict=True):
        for axis, (triad, curve) in zip(row, fit.curves.items(), strict=True):
            _curves(axis, curve)
            _slopes(axis, curve, fit.slopes[triad])
            axis.set_title(f"{name}: {triad}, {curve.duration_s:.0f} s at rest", fontsize=10)
            axis.set_xlabel("averaging time (s)")
            axis.set_ylabel(f"Allan deviation ({UNITS[triad]})")
            axis.legend(fontsize=8)
    return save(figure, path)


def _curves(axis: Axes, curve: AllanCurve) -> None:
    for k, colour in enumerate(AXIS):
        deviation = curve.deviation[:, k]
        axis.loglog(curve.tau, deviation, ".-", color=colour, lw=1.0, ms=4, label="xyz"[k])
        low, high = (deviation * (1.0 + s * curve.relative_error) for s in (-1.0, 1.0))
        axis.fill_between(curve.tau, low, high, color=colour, alpha=0.15, linewidth=0)


def _slopes(axis: Axes, curve: AllanCurve, slopes: Sequence[Slopes]) -> None:
    """Mark the worst axis' slopes with the number that is read off each."""
    tau = curve.tau
    white = [s.white for s in slopes if s.white is not None]
    floor = [s for s in slopes if s.floor is not None and s.floor_tau is not None]
    walk = [s.walk for s in slopes if s.walk is not None]
    if white:
        level: FloatArray = max(white) / np.sqrt(tau)
        axis.loglog(tau, level, "--", color=MARKER, lw=0.9, label=f"N = {max(white):.2g} /√Hz")
    if floor:
        worst = max(floor, key=lambda s: s.floor or 0.0)
        height = (worst.floor or 0.0) * FLOOR
        axis.axhline(height, ls=":", color=MARKER, lw=1.1, label=f"B = {worst.floor:.2g}")
    if walk:
        level = max(walk) * np.sqrt(tau / 3.0)
        seen = level > curve.deviation.min() / 2.0
        label = f"K = {max(walk):.2g} /√s"
        axis.loglog(tau[seen], level[seen], "-.", color=TRUTH, lw=1.2, label=label)
