"""Figures of calibrations; matplotlib is imported only when one is drawn."""

from .abreast import draw_spacing
from .allan_curves import draw_allan
from .residuals import draw_residuals

__all__ = ["draw_allan", "draw_residuals", "draw_spacing"]
