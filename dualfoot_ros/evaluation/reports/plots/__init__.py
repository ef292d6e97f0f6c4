"""Figures of evaluated walks; matplotlib is imported only when one is drawn."""

from .methods import draw_compared, draw_sweep
from .nees_curves import draw_consistency
from .one_walk import draw_all
from .style import FOOT, GREEN, MARKER, PINK, TRUTH, new_figure, save

__all__ = [
    "FOOT",
    "GREEN",
    "MARKER",
    "PINK",
    "TRUTH",
    "draw_all",
    "draw_compared",
    "draw_consistency",
    "draw_sweep",
    "new_figure",
    "save",
]
