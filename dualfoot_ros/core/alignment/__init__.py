"""Levelling and gyro bias: standstills weighed by their stillness, and the start of a track."""

from .foot_stand import FootStand, FootStandstill, stillness
from .last_stand import bias_after, last_stand
from .prior import BiasPrior
from .sampling_rate import SamplingRate
from .start import Alignment, Start, StartKind
from .whole_windows import WholeWindows
from .window import Window, WindowSlider

__all__ = [
    "Alignment",
    "BiasPrior",
    "FootStand",
    "FootStandstill",
    "SamplingRate",
    "Start",
    "StartKind",
    "WholeWindows",
    "Window",
    "WindowSlider",
    "bias_after",
    "last_stand",
    "stillness",
]
