"""The error of the drivers: what a user got wrong about a source, never bad bytes."""

from ..core.errors import DualFootError


class SourceError(DualFootError):
    """A source, a format or one of its options is unknown, malformed or cannot be used."""
