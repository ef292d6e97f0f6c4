"""What a caller can get wrong about a simulated walk."""

from ..core.errors import DualFootError


class SimulationError(DualFootError):
    """A walk, a route or a sensor grade that cannot be simulated."""
