"""Time: two streams of samples become pairs with equal stamps."""

from typing import TYPE_CHECKING

from ..lazy_face import lazy_face

if TYPE_CHECKING:
    from ..core import TimingError
    from .clock.clock_config import DeviceClockConfig
    from .clock.counter import CounterConfig, Unwrapper
    from .clock.counter import CounterConfig as Counter  # its name in version 0.1
    from .clock.device_clock import DeviceClock
    from .clock.stamps import POLICIES, StampConfig, Stamps
    from .clock.stamps import StampConfig as Stamping  # its name in version 0.1
    from .clock.state import ClockState
    from .offset.even_stamps import EvenStamps, even_stamps
    from .offset.motion_offset import offset_by_motion
    from .offset.result import Offset
    from .offset.synchronise import Synchronised, synchronise
    from .pairing.batch import AlignReport, align, align_with_report
    from .pairing.pairing_config import AlignerConfig
    from .pairing.stream_gate import Clean, clean, finite_samples
    from .pairing.streaming import Aligner

__all__ = [
    "POLICIES",
    "AlignReport",
    "Aligner",
    "AlignerConfig",
    "Clean",
    "ClockState",
    "Counter",
    "CounterConfig",
    "DeviceClock",
    "DeviceClockConfig",
    "EvenStamps",
    "Offset",
    "StampConfig",
    "Stamping",
    "Stamps",
    "Synchronised",
    "TimingError",
    "Unwrapper",
    "align",
    "align_with_report",
    "clean",
    "even_stamps",
    "finite_samples",
    "offset_by_motion",
    "synchronise",
]

__getattr__, __dir__ = lazy_face(__name__)
