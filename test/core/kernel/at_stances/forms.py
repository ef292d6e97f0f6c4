"""Both forms of the kernel on copies of one state, for tests of what acts at a stance."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core.kernel import interpreted
from dualfoot_ros.core.kernel import layout as lay

from ...harness import quick_engine


def both_forms(entry: str, *arrays: np.ndarray, given: tuple = ()):
    """Run an entry in both forms, assert equal bits, and return (its result, arrays after)."""
    if quick_engine().name == "interpreted":
        pytest.skip("needs a C compiler (cc) or numba")
    results = []
    for engine in (interpreted(), quick_engine()):
        copies = [each.copy() for each in arrays]
        result = getattr(engine, entry)(*copies, *given)
        results.append((None if result is None else float(result), copies))
    (one, ours), (other, theirs) = results
    assert np.array_equal([one], [other], equal_nan=one is not None)
    for a, b in zip(ours, theirs, strict=True):
        assert a.tobytes() == b.tobytes()
    return one, ours


def numbers() -> np.ndarray:
    """Return the array beside the workspace, empty."""
    return np.zeros(lay.X_SIZE)
