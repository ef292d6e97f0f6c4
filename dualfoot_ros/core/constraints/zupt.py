"""``zupt``: zero-velocity updates only, both feet uncoupled (the base of all four papers)."""

from __future__ import annotations

from dataclasses import dataclass

from ..parameters import Parameters


@dataclass(frozen=True)
class Config(Parameters):
    """The base has no parameters of its own."""
