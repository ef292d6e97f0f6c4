"""Residuals of an accelerometer at rest, before and after its calibration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ...evaluation.reports.plots import GREEN, MARKER, PINK, new_figure, save
from ..accelerometer import AccelerometerFit, rms
from ..static import Segment


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
