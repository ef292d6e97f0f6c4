"""Which device axes point forward, left and up."""

from __future__ import annotations

import re

import numpy as np

from ...core.series import FloatArray
from ..errors import RecordingError

IDENTITY = "+x+y+z"
RIGHT_FRONT_UP = "+y-x+z"  # forward is y, left is against x
PATTERN = re.compile(r"([+-])([xyz])" * 3)


def parse(axes: str) -> FloatArray:
    """Return the (3, 3) rotation from device axes to forward-left-up.

    ``axes`` names the device axis, with its sign, that points forward, then left, then up:
    ``+x+y+z`` for a device that is forward-left-up already, ``+y-x+z`` for right-front-up.

    Raises
    ------
    RecordingError
        When it names no three different axes, or a left-handed set.
    """
    match = PATTERN.fullmatch(axes)
    if match is None:
        raise _refusal(axes, "it is not three signed axes")
    signs, names = match.groups()[0::2], match.groups()[1::2]
    rotation = np.zeros((3, 3))
    for row, (sign, name) in enumerate(zip(signs, names, strict=True)):
        rotation[row, "xyz".index(name)] = 1.0 if sign == "+" else -1.0
    if abs(np.linalg.det(rotation)) < 0.5:
        raise _refusal(axes, "an axis occurs twice")
    if np.linalg.det(rotation) < 0.0:
        raise _refusal(axes, "this set is left-handed, so one sign is wrong")
    return rotation


def _refusal(axes: str, reason: str) -> RecordingError:
    return RecordingError(
        f"axes are '{axes}': {reason}; allowed are the signed device axes that point forward, "
        f"left and up, as in '{IDENTITY}' or '{RIGHT_FRONT_UP}'"
    )
