"""The whole of a running tracker as bytes, to go on from there bit for bit."""

from .snapshot_format import dump, restore

__all__ = ["dump", "restore"]
