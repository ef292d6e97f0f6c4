"""stub"""
from __future__ import annotations
from dataclasses import dataclass
from ..parameters import Parameters, parameter

@dataclass(frozen=True)
class Config(Parameters):
    """Parameters of the minimum-distance constraint."""

    distance: float = parameter(0.15, "minimum distance c0", unit="m", minimum=0.01, maximum=1.0)
