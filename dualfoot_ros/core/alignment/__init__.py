"""Levelling and gyro bias: standstills weighed by their stillness, and the start of a track."""

from .foot_stand import FootStand, FootStandstill, stillness
from .prior import BiasPrior
from .sampling_rate import SamplingRate
from .start import Alignment, Start, StartKind
from .window import Window, WindowSlider

__all__ = [
    "Alignment",
    "BiasPrior",
    "FootStand",
    "FootStandstill",
    "SamplingRate",
    "Start",
    "StartKind",
    "Window",
    "WindowSlider",
    "stillness",
]
