"""Time: two streams of samples become pairs with equal stamps."""

from .align import AlignReport, align, align_with_report
from .aligner import Aligner
from .clean import Clean, clean
from .config import Sync
from .errors import TimingError

__all__ = [
    "AlignReport",
    "Aligner",
    "Clean",
    "Sync",
    "TimingError",
    "align",
    "align_with_report",
    "clean",
]
