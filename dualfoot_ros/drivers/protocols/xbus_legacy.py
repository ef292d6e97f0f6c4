"""MTData of older Xsens devices (MTi first generation, MTx): calibrated data without identifiers.

After the maker's MT Low Level Communication Protocol, message 0x32: temperature (4 bytes, where it
is switched on), acceleration, rate of turn and magnetic field (12 bytes each), orientation, status
and a sample counter (2 bytes) at the end; all but the last two are big-endian floats.  The message
does not say which of these it has, so the option ``mtdata_temperature`` does for the first.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

from ...core import Vector

CALIBRATED = struct.Struct(">9f")
TEMPERATURE = struct.Struct(">f")
ORIENTATIONS = (0, 12, 16, 36)  # none, Euler angles, quaternion, matrix
STATUS, COUNTER = 1, 2


class Calibrated(NamedTuple):
    """The content of an MTData message."""

    force: Vector
    rate: Vector
    field: Vector
    temperature: float | None
    counter: int | None


def read_mtdata(content: bytes, with_temperature: bool) -> Calibrated | None:
    """Return the calibrated data of a message, or None where its length does not fit any."""
    at = TEMPERATURE.size if with_temperature else 0
    behind = len(content) - at - CALIBRATED.size
    ends = {o + s + c: c for o in ORIENTATIONS for s in (0, STATUS) for c in (0, COUNTER)}
    if behind not in ends:
        return None
    values = CALIBRATED.unpack_from(content, at)
    return Calibrated(
        values[0:3],
        values[3:6],
        values[6:9],
        TEMPERATURE.unpack_from(content)[0] if with_temperature else None,
        int.from_bytes(content[-COUNTER:], "big") if ends[behind] else None,
    )
