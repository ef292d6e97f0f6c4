"""Updates of a part of a simulated walk."""

import numpy as np

from dualfoot_ros.core import DualFootTracker, ImuPair, TrackerConfig, Update
from dualfoot_ros.simulation import WalkConfig, simulate


def tracked(first: int, count: int, **options: float) -> list[Update]:
    """Return the updates of a part of a walk that have an estimate."""
    made = simulate(WalkConfig(route="straight", rate=60.0, standing=3.0), seed=1)
    tracker = DualFootTracker(TrackerConfig.from_mapping(options), engine="compiled")
    rows = np.hstack(
        [
            each
            for foot in (made.left, made.right)
            for each in (foot.specific_force, foot.angular_rate)
        ]
    )
    part = slice(first, first + count)
    pairs = zip(made.left.stamp_ns[part].tolist(), rows[part], strict=True)
    found = [tracker.add(ImuPair(stamp_ns, values)) for stamp_ns, values in pairs]
    return [update for update in found if update.row is not None]
