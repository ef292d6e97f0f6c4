"""The vector between the feet in passing, brought to a spacing across the heading.

Ma and Särkkä 2023, III-C, eqs (5)-(9), as `core.constraints.spacing_vector` has it.
"""

from ..layout import (
    E_ATT,
    JOINT,
    KNOW_NOTHING,
    S_H,
    SIDE,
    X_AFTER,
    X_BEFORE,
    X_DISTANCE,
    X_LATERAL,
    X_NIS,
    X_NOISE,
    X_Y,
)
from ..turn import keeps_gauge
from .observation import observe
from .separation import put_relative_row, separation

LEAST_NOISE = 1e-12  # m^2, of a hard projection


def constrain_spacing(w, x, ahead_x, ahead_y, spacing, std, height_std, lateral, kind):
    """Update with the spacing to the left of (ahead_x, ahead_y), a unit vector; return the NIS.

    ``std`` and ``height_std`` m are the scatter of the spacing and of the difference in height,
    which is not constrained when that is zero.  ``lateral`` keeps only the component across the
    heading.  ``kind`` is what the update leaves alone.
    """
    x[X_DISTANCE] = separation(w, x, X_BEFORE)
    left_x = -ahead_y
    left_y = ahead_x
    x[X_LATERAL] = x[X_BEFORE] * left_x + x[X_BEFORE + 1] * left_y
    # the feet are where they are however the walk is turned, even where they do not fit
    side_x = spacing * left_x
    side_y = spacing * left_y
    if keeps_gauge(w, 0) or keeps_gauge(w, 1):
        side_x = x[X_BEFORE]
        side_y = x[X_BEFORE + 1]
    turns = kind != KNOW_NOTHING
    noise = max(std * std, LEAST_NOISE)
    rows = 1
    if lateral:
        put_relative_row(w, 0, left_x, left_y, 0.0)
        measure(x, 0, x[X_LATERAL] - spacing, noise)
        if turns:
            turn_target(w, 0, left_x * side_y - left_y * side_x)
    else:
        rows = 2
        put_relative_row(w, 0, 1.0, 0.0, 0.0)
        measure(x, 0, x[X_BEFORE] - spacing * left_x, noise)
        put_relative_row(w, 1, 0.0, 1.0, 0.0)
        measure(x, 1, x[X_BEFORE + 1] - spacing * left_y, noise)
        if turns:
            turn_target(w, 0, side_y)
            turn_target(w, 1, -side_x)
    if height_std > 0.0:
        put_relative_row(w, rows, 0.0, 0.0, 1.0)
        measure(x, rows, x[X_BEFORE + 2], max(height_std * height_std, LEAST_NOISE))
        rows += 1
    nis = observe(w, x, rows, kind)
    separation(w, x, X_AFTER)
    x[X_NIS] = nis
    return nis


def measure(x, k, innovation, noise):
    """Take the innovation and the noise of row ``k``."""
    x[X_Y + k] = innovation
    x[X_NOISE + k] = noise


def turn_target(w, k, lever):
    """Let the target of row ``k`` turn with the mean heading, by ``lever`` m/rad."""
    for foot in range(2):
        w[S_H + JOINT * k + SIDE * foot + E_ATT + 2] = -0.5 * lever
