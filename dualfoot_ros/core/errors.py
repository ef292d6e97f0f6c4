"""The one exception root of the package, and the errors of the core.

Bad *data* is never an exception on the live path: it is refused and counted.  These errors are
for what a caller got wrong before any data flowed: a configuration, a shape, a file.
"""


class DualFootError(Exception):
    """Root of every error this package raises on purpose."""


def os_error_text(error: OSError) -> str:
    """Return what the system says of a file, without its number: ``'walk': Permission denied``."""
    if error.strerror is None:
        return str(error)
    return f"'{error.filename}': {error.strerror}" if error.filename else error.strerror


class ConfigError(DualFootError):
    """A parameter is unknown, of the wrong type or out of its range."""


class SeriesError(DualFootError):
    """Arrays handed to a series do not fit together."""


class AlignmentError(DualFootError):
    """A recording has no standstill from which to level the sensors."""


class CalibrationError(DualFootError):
    """A recording does not tell what is asked of it, or a calibration file cannot be used."""


class SnapshotError(DualFootError):
    """A snapshot of a tracker is damaged, or of another version."""


class SourceError(DualFootError):
    """A source, a format or one of its options is unknown, malformed or cannot be used."""


class EvaluationError(DualFootError):
    """An estimate and its reference do not fit together, or a result cannot be written."""


class RecordingError(DualFootError):
    """A bag, a sensor export or a reference file cannot be read, used or written."""


class SimulationError(DualFootError):
    """A walk, a route or a sensor grade that cannot be simulated."""


class TimingError(DualFootError):
    """Two recordings cannot be brought on one time grid."""
