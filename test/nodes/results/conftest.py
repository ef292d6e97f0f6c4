"""What several tests of the results need."""

import pytest

from .updates import tracked


@pytest.fixture(scope="package")
def updates():
    """Return the updates of the start of a walk that have an estimate."""
    return tracked(0, 400)
