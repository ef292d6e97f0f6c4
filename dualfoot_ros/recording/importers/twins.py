"""Refusal of one source that is given for both feet."""

from __future__ import annotations

import numpy as np

from ...core import RecordingError
from ..recording import Recording


def without_twins(recording: Recording) -> Recording:
    """Return the recording.

    Raises
    ------
    RecordingError
        When both feet hold the same samples: a file or topic was given twice, or copied.
    """
    left, right = recording.left, recording.right
    if left is None or right is None or not len(left):
        return recording
    if all(
        np.array_equal(getattr(left, name), getattr(right, name), equal_nan=True)
        for name in ("stamp_ns", "specific_force", "angular_rate")
    ):
        raise RecordingError(
            "both feet hold the same samples, so one file or topic was given or exported twice; "
            "give that of the other foot"
        )
    return recording
