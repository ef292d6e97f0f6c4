"""What several tests of the results need."""

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, ImuPair
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.fixture(scope="package")
def updates():
    """Return the updates of the start of a walk that have an estimate."""
    made = simulate(WalkConfig(route="straight", rate=60.0, standing=3.0), seed=1)
    tracker = DualFootTracker(engine="interpreted")
    rows = np.hstack(
        [
            each
            for foot in (made.left, made.right)
            for each in (foot.specific_force, foot.angular_rate)
        ]
    )
    pairs = zip(made.left.stamp_ns[:400].tolist(), rows, strict=False)
    found = [tracker.add(ImuPair(stamp_ns, values)) for stamp_ns, values in pairs]
    return [update for update in found if update.row is not None]
