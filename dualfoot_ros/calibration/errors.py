"""What can be wrong with a calibration."""

from ..core.errors import DualFootError


class CalibrationError(DualFootError):
    """A recording does not tell what is asked of it, or a calibration file cannot be used."""
