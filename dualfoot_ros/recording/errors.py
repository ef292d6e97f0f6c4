"""What can be wrong with a recording or the files around it."""

from ..core.errors import DualFootError


class RecordingError(DualFootError):
    """A bag, a sensor export or a reference file cannot be read, used or written."""
