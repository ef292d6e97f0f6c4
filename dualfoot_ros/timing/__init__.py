"""Time: two streams of samples become pairs with equal stamps."""

from .clean import Clean, clean
from .clock.clock_config import ClockModel
from .clock.counter import Counter, Unwrapper
from .clock.device_clock import DeviceClock
from .clock.stamps import Stamping, Stamps
from .clock.state import ClockState
from .errors import TimingError
from .offset.motion_offset import offset_by_motion
from .offset.result import Offset
from .offset.synchronise import Synchronised, synchronise
from .pairing.batch import AlignReport, align, align_with_report
from .pairing.pairing_config import Sync
from .pairing.streaming import Aligner

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
