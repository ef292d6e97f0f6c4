"""Figures of calibrations; matplotlib is imported only when one is drawn."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core import FloatArray
from ..evaluation.reports.plots import FOOT, GREEN, MARKER, PINK, TRUTH, new_figure, save
from .accelerometer import AccelerometerFit, rms
from .allan import FLOOR, AllanCurve, Slopes
from .gyro import UNITS, GyroFit
from .spacing import SpacingFit
from .static import Segment

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AXIS = (FOOT["left"], FOOT["right"], GREEN)


def draw_residuals(
    fits: Mapping[str, tuple[AccelerometerFit, Sequence[Segment]]], path: Path
) -> Path:
    """Draw the residuals before and after, one panel a sensor, one row a standstill."""
    most = max(len(segments) for _, segments in fits.values())
    figure, axes = new_figure(
        max(6.5, 5.2 * len(fits)), 1.8 + 0.24 * most, columns=len(fits), sharex=True
    )
    for axis, (name, (fit, segments)) in zip(axes.flat, fits.items(), strict=True):
        rows = np.arange(len(segments))[::-1]
        axis.axvline(0.0, color=MARKER, linewidth=0.8)
        axis.plot(
            fit.residual_before,
            rows,
            "o",
            color=PINK,
            label=f"as measured, RMS {rms(fit.residual_before):.4f}",
        )
        axis.plot(
            fit.residual_after,
            rows,
            "s",
            color=GREEN,
            markersize=4,
            label=f"calibrated, RMS {rms(fit.residual_after):.4f}",
        )
        axis.set_yticks(rows, [s.name for s in segments], fontsize=7)
        axis.set_ylim(-0.7, len(segments) - 0.3)
        zero = " (zero by construction)" if fit.zero_by_construction else ""
        axis.set_title(f"{name}: {fit.model}, {fit.attitudes} attitudes{zero}", fontsize=9)
        axis.set_xlabel("|specific force| - g (m/s²)")
        axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.22), ncols=2)
    figure.suptitle("accelerometer at rest", fontsize=11)
    return save(figure, path)


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


def draw_spacing(fit: SpacingFit, path: Path, title: str) -> Path:
    """Draw where the feet are abreast in the stances, and the walk that told the spacing."""
    figure, axes = new_figure(10.0, 4.4, columns=2)
    _walk(axes[0, 0], fit)
    _abreast(axes[0, 1], fit)
    figure.suptitle(f"{title}: the feet in passing", fontsize=11)
    return save(figure, path)


def _walk(axis: Axes, fit: SpacingFit) -> None:
    middle = np.array([p.middle for p in fit.passings])
    axis.plot(*middle.T, "-", color=TRUTH, lw=1.0, label="between the feet")
    for foot, (name, colour) in enumerate(FOOT.items()):
        at = np.array([p.standing == foot for p in fit.passings])
        axis.plot(*middle[at].T, ".", color=colour, ms=5, label=f"{name} foot stands")
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_xlabel("x (m)")
    axis.set_ylabel("y (m)")
    turned = math.degrees(fit.feet.turned_rad)
    axis.set_title(
        f"turned through {turned:.0f}°: spacing {fit.feet.spacing_m:.3f} ± {fit.feet.std_m:.3f} m",
        fontsize=9,
    )
    axis.legend(fontsize=8)


def _abreast(axis: Axes, fit: SpacingFit) -> None:
    shares = np.array(fit.kappas)
    axis.hist(shares, bins=np.arange(0.3, 0.81, 0.02).tolist(), color=GREEN, alpha=0.7)
    axis.axvline(fit.kappa, color=MARKER, lw=1.2)
    axis.set_xlabel("share of the stance at which the feet are abreast")
    axis.set_ylabel("steps on straight parts")
    axis.set_title(f"kappa {fit.kappa:.3f}, from step to step ± {fit.kappa_std:.3f}", fontsize=9)
