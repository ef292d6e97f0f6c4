"""Values of any kind in the types that JSON has."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import Enum
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """Return ``value`` in the types that JSON has; not-a-number and infinity become None."""
    if isinstance(value, float):  # most of a report; of NumPy too
        return float(value) if math.isfinite(value) else None
    if isinstance(value, (str, int, type(None))) and not isinstance(value, Enum):
        return value
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, set)):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return plain(value.item())
    return value.value if isinstance(value, Enum) else value
