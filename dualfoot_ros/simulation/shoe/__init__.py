"""The exact motion of one shoe, and what turns with it."""

from .euler_angles import EulerAngles, rotation_zyx
from .shoe_motion import Poses, ShoeMotion

__all__ = ["EulerAngles", "Poses", "ShoeMotion", "rotation_zyx"]
