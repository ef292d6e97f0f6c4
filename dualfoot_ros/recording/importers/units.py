"""Units a sensor may speak, and what one of them is in SI."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..errors import RecordingError

STANDARD_GRAVITY = 9.80665
FORCE_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY * 1e-3}
RATE_UNITS = {"rad/s": 1.0, "deg/s": math.pi / 180.0, "mdeg/s": math.pi / 180e3}


def scale(what: str, unit: str, known: Mapping[str, float]) -> float:
    """Return ``unit`` in SI; raise RecordingError with the ``known`` ones when it is none."""
    if unit not in known:
        raise RecordingError(f"{what} is '{unit}'; allowed is one of {', '.join(known)}")
    return known[unit]
