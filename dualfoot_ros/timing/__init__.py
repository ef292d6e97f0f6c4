"""Time: two streams of samples become pairs with equal stamps."""

from .align import AlignReport, align, align_with_report
from .aligner import Aligner
from .clean import Clean, clean
from .clock.config import ClockModel
from .clock.counter import Counter, Unwrapper
from .clock.device import DeviceClock
from .clock.stamps import Stamping, Stamps
from .clock.state import ClockState
from .config import Sync
from .errors import TimingError
from .offset.motion import offset_by_motion
from .offset.recording import Synchronised, synchronise
from .offset.result import Offset

__all__ = [
    "AlignReport",
    "Aligner",
    "Clean",
    "ClockModel",
    "ClockState",
    "Counter",
    "DeviceClock",
    "Offset",
    "Stamping",
    "Stamps",
    "Sync",
    "Synchronised",
    "TimingError",
    "Unwrapper",
    "align",
    "align_with_report",
    "clean",
    "offset_by_motion",
    "synchronise",
]
