"""Units that sensors speak, and what one of each is in SI."""

from __future__ import annotations

import math

STANDARD_GRAVITY = 9.80665
"""m/s^2 in one g, by definition."""

DEGREE = math.pi / 180.0
"""rad in one degree."""

FORCE_UNITS = {"m/s^2": 1.0, "g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY * 1e-3}

RATE_UNITS = {"rad/s": 1.0, "deg/s": DEGREE, "mdeg/s": math.pi / 180e3}
