"""Tracks of two feet without any constraint between them, for tests that compare them."""

from dualfoot_ros.core import DualFootTracker
from dualfoot_ros.inspection import unconstrained_config
from dualfoot_ros.timing import align


def track_feet(left, right):
    """Pair the samples of both feet and track each foot by itself."""
    return DualFootTracker(unconstrained_config()).run(*align(left, right))
