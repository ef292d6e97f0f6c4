"""The one exception root of the package, and the errors of the core.

Bad *data* is never an exception on the live path: it is refused and counted.  These errors are
for what a caller got wrong before any data flowed: a configuration, a shape, a file.
"""


class DualFootError(Exception):
    """Root of every error this package raises on purpose."""


class ConfigError(DualFootError):
    """A parameter is unknown, of the wrong type or out of its range."""


class SeriesError(DualFootError):
    """Arrays handed to a series do not fit together."""


class AlignmentError(DualFootError):
    """A recording has no standstill from which to level the sensors."""
