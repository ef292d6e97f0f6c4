"""What an update says of an epoch beside its numbers."""

from __future__ import annotations

from typing import Any, NamedTuple

from .events import Event
from .facing import NO_FACING, Facing


class Context(NamedTuple):
    """What an update says beside numbers: of most it is that of the update before.

    ``facing`` is what the headings of the feet follow from, ``refused`` why the pair was refused,
    if it was; ``events`` are those of the epoch without the zero-velocity updates, ``earlier`` the
    updates of the pairs that had waited for this one.
    """

    phase: str
    facing: Facing = NO_FACING
    events: tuple[Event, ...] = ()
    refused: str | None = None
    earlier: tuple[Any, ...] = ()
