"""Tables of messages that come block by block."""

import numpy as np
import pytest

from dualfoot_ros.recording.message_tables import _Rows


@pytest.mark.parametrize("expected", [0, 5, 10, 1000, 10**12])
def test_rows_are_kept_whatever_number_was_expected(expected):
    """A bag may say anything of how many messages it has."""
    whole = np.random.default_rng(0).normal(size=(40, 3))
    rows = _Rows(expected)
    for part in np.split(whole, [7, 7, 20]):
        rows.add(part)
    assert np.array_equal(rows.all(), whole)
