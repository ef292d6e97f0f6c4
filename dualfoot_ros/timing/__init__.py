"""Time: two streams of samples become pairs with equal stamps."""

from ..core import TimingError
from .clock.clock_config import ClockModel
from .clock.counter import Counter, Unwrapper
from .clock.device_clock import DeviceClock
from .clock.stamps import POLICIES, Stamping, Stamps
from .clock.state import ClockState
from .offset.motion_offset import offset_by_motion
from .offset.result import Offset
from .offset.synchronise import Synchronised, synchronise
from .pairing.batch import AlignReport, align, align_with_report
from .pairing.pairing_config import Sync
from .pairing.stream_gate import Clean, clean
from .pairing.streaming import Aligner

__all__ = [
    "POLICIES",
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
