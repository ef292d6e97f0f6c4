"""The tracking of two feet from one alignment on."""

from .given_pose import GivenPose, given_pose
from .session import Session

__all__ = ["GivenPose", "Session", "given_pose"]
