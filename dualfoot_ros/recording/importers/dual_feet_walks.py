"""References of the walks of the dual-feet data set: floor markers and closed loops.

The right foot steps on markers 1.2 m apart that form a rectangle of 9.6 m by 2.4 m.  Points are
in the frame of the data set: x to the right and y forward at the start, z up.  A clockwise walk
is the counter-clockwise one with x mirrored.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...core import FloatArray
from ..reference import Reference

MARKER_SPACING_M = 1.2
LAP_M = 400.0

# Corners in units of the marker spacing, counter-clockwise; there is a marker at every unit
# between them.  The order of the figure eight is not in the data set's description: it is the
# one that the tracks of all its walks show (25 stances, each within 0.2 m of a marker).
RECTANGLE = ((0, 0), (0, 8), (-2, 8), (-2, 0), (0, 0))
FIGURE_EIGHT = (
    (0, 0),
    (0, 4),
    (-2, 4),
    (-2, 8),
    (0, 8),
    (0, 4),
    (-2, 4),
    (-2, 0),
    (0, 0),
)


def reference_of(shape: str, direction: int) -> Reference | None:
    """Return the reference of a walk by its ``pathshape`` and ``pathdirec``, or None."""
    mirror = -1.0 if direction < 0 else 1.0
    round_ = "clockwise" if direction < 0 else "counter-clockwise"
    if shape == "rec":
        return _marked(RECTANGLE, mirror, f"dual-feet data set, rectangle, {round_}")
    if shape == "8":
        return _marked(
            FIGURE_EIGHT,
            mirror,
            "dual-feet data set, figure eight (order of the markers read off the tracks)",
        )
    if shape == "O":
        return Reference(
            f"dual-feet data set, one lap of a 400 m running track, {round_}",
            closed_loop=True,
            length_m=LAP_M,
        )
    return None


def _marked(corners: tuple[tuple[int, int], ...], mirror: float, source: str) -> Reference:
    points = markers(corners) * [mirror, 1.0, 1.0]
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return Reference(source, {"right": points}, closed_loop=True, length_m=round(length, 6))


def markers(corners: tuple[tuple[int, int], ...]) -> FloatArray:
    """Return (K, 3) m, a marker at each corner and at every unit of spacing between corners."""
    points = [np.array(corners[0], dtype=np.float64)]
    for start, end in pairwise(corners):
        way = np.subtract(end, start)
        steps = int(np.abs(way).max())
        points += [np.add(start, way * (k / steps)) for k in range(1, steps + 1)]
    flat = np.array(points) * MARKER_SPACING_M
    return np.column_stack([flat, np.zeros(len(flat))])
