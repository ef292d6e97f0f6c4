"""What can be wrong with a request to evaluate."""

from ..core.errors import DualFootError


class EvaluationError(DualFootError):
    """An estimate and its reference do not fit together, or a result cannot be written."""
