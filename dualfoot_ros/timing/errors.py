"""What can be wrong with the time of two streams."""

from ..core.errors import DualFootError


class TimingError(DualFootError):
    """Two recordings cannot be brought on one time grid."""
