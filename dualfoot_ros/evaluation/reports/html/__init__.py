"""``report.html``: findings, figures and plots of a walk or a comparison in one file.

What other pages share with it is in `document`, `figure`, `section` and ``charts.js``.
"""

from .comparison_page import write_comparison_page
from .page import HOW_TO_MOVE, asset, document, figure, section
from .walk_page import write_walk_page

__all__ = [
    "HOW_TO_MOVE",
    "asset",
    "document",
    "figure",
    "section",
    "write_comparison_page",
    "write_walk_page",
]
