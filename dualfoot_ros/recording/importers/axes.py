"""Which device axes point forward, left and up."""

from __future__ import annotations

import numpy as np

from ...core import FloatArray, axes_matrix

IDENTITY = "+x+y+z"
RIGHT_FRONT_UP = "+y-x+z"  # forward is y, left is against x


def parse(axes: str) -> FloatArray:
    """Return the (3, 3) rotation from device axes to forward-left-up, as ``axes_matrix`` does.

    Raises
    ------
    ConfigError
        When it names no three different axes, or a left-handed set.
    """
    return np.array(axes_matrix(axes))
