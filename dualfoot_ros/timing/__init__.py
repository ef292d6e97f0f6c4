"""Time: two streams of samples become pairs with equal stamps."""

from .align import AlignReport, align, align_with_report
from .aligner import Aligner
from .clean import Clean, clean
from .clock import DeviceClock
from .clock_config import ClockModel
from .clock_counter import Counter, Unwrapper
from .clock_stamps import Stamping, Stamps
from .clock_state import ClockState
from .config import Sync
from .errors import TimingError
from .motion import offset_by_motion
from .motion_offset import Offset
from .motion_recording import Synchronised, synchronise

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
