"""The groups of parameters of the tracker, each a class with its defaults."""

from .aids_group import AidsConfig
from .filter_groups import FloorConfig, NoiseConfig, StanceConfig, ZuptConfig
from .start_groups import AlignmentConfig, HeadingConfig, IncrementsConfig, InitialConfig

__all__ = [
    "AidsConfig",
    "AlignmentConfig",
    "FloorConfig",
    "HeadingConfig",
    "IncrementsConfig",
    "InitialConfig",
    "NoiseConfig",
    "StanceConfig",
    "ZuptConfig",
]
