"""Where in a stance the feet are abreast, and the walk that showed their spacing."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...evaluation.reports.plots import FOOT, GREEN, MARKER, TRUTH, new_figure, save
from ..spacing import SpacingFit

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_spacing(fit: SpacingFit, path: Path, title: str) -> Path:
    """Draw where the feet are abreast in the stances, and the walk that showed the spacing."""
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
