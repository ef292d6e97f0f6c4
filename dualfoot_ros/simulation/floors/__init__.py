"""Floors that carry the walker."""

from .moving_floor import MovingFloorConfig, on_moving_floor

__all__ = ["MovingFloorConfig", "on_moving_floor"]
