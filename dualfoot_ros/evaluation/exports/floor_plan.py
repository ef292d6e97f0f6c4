"""A picture of the floor that lies under the track on the page of a report."""

from __future__ import annotations

import base64
import math
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...core import EvaluationError
from ..tracked_person import PersonTrack
from .geo_origin import start_direction

SIGNATURE = b"\x89PNG\r\n\x1a\n"
SIZE_AT = slice(16, 24)  # width and height in the first chunk of a PNG


@dataclass(frozen=True)
class FloorPlan:
    """A PNG, its scale, and where on it the walk starts.

    Attributes
    ----------
    png : the bytes of the picture
    scale : m for one pixel
    start : (column, row) of the start in pixels, from the upper left corner
    direction : of the first metres on the picture, degrees: 0 to the right, 90 up
    """

    png: bytes
    scale: float
    start: tuple[float, float]
    direction: float = 0.0

    @classmethod
    def load(cls, path: str | Path, scale: float | None, start: str | None) -> FloorPlan:
        """Read the picture ``path``; ``start`` is ``COLUMN,ROW`` or ``COLUMN,ROW,DIRECTION``.

        Raises
        ------
        EvaluationError
            When it is no PNG, or scale or start are missing or not understood.
        OSError
            When it cannot be read.
        """
        png = Path(path).read_bytes()
        if not png.startswith(SIGNATURE):
            raise EvaluationError(f"floor plan '{path}' is no PNG; convert it to one")
        if scale is None or not (math.isfinite(scale) and scale > 0):
            raise EvaluationError(
                f"--scale is {'missing' if scale is None else scale}; with --floor-plan it is "
                "needed: more than 0 m for one pixel"
            )
        return cls(png, scale, *_start(start))

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        width, height = struct.unpack(">II", self.png[SIZE_AT])
        return width, height

    def picture(self, person: PersonTrack) -> dict[str, Any]:
        """Return the picture for the plot of a track: its bytes, place, size and turn.

        ``x``, ``y`` is the start in the frame of the track, ``left`` and ``up`` are the distances
        from it to the upper left corner before the picture is turned by ``angle`` degrees.
        """
        width, height = self.size
        return {
            "href": "data:image/png;base64," + base64.b64encode(self.png).decode("ascii"),
            "x": float(person.position[0, 0]),
            "y": float(person.position[0, 1]),
            "left": self.start[0] * self.scale,
            "up": self.start[1] * self.scale,
            "width": width * self.scale,
            "height": height * self.scale,
            "angle": math.degrees(start_direction(person)) - self.direction,
        }


def _start(text: str | None) -> tuple[tuple[float, float], float]:
    try:
        values = [float(part) for part in (text or "").split(",")]
    except ValueError:
        values = []
    if len(values) not in (2, 3) or not all(map(math.isfinite, values)):
        raise EvaluationError(
            f"--start-pixel is {'missing' if text is None else repr(text)}; with --floor-plan it "
            "is needed: COLUMN,ROW or COLUMN,ROW,DIRECTION (pixels from the upper left; degrees, "
            "0 right, 90 up)"
        )
    return (values[0], values[1]), values[2] if len(values) == 3 else 0.0
