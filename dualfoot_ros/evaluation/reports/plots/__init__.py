"""Figures of evaluated walks; matplotlib is imported only when one is drawn."""

from .one_walk import draw_all

__all__ = ["draw_all"]
