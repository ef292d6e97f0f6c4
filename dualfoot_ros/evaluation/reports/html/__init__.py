"""``report.html``: findings, figures and plots of a walk or a comparison in one file."""

from .comparison_page import write_comparison_page
from .walk_page import write_walk_page

__all__ = ["write_comparison_page", "write_walk_page"]
