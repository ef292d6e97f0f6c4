"""Pairs that are taken many at once are ones that the gate would take one by one."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.samples.pair_gate import LIMIT, MAX_GAP_NS, PairGate

ENDS = np.iinfo(np.int64)
steps = st.sampled_from((10_000_000, 10_000_000, 0, -1, MAX_GAP_NS, MAX_GAP_NS + 1, 2 * 10**10))
starts = st.sampled_from((10**18, int(ENDS.min), int(ENDS.max)))
numbers = st.sampled_from((1.0, 1.0, 1.0, LIMIT, np.nan, -np.inf))


@given(st.lists(st.tuples(starts, steps, numbers), min_size=1, max_size=12))
def test_no_plain_pair_would_be_refused_and_the_first_other_one_is_not_plain(given):
    stamps, values = np.array(stamps_of(given)), np.ones((len(given), 12))
    values[:, 4] = [number for _, _, number in given]
    gate = PairGate()
    assert gate.plain(stamps, values) == 0  # it knows of no pair before
    gate.step(int(stamps[0]) - 10_000_000 if stamps[0] > ENDS.min else int(stamps[0]))
    count = gate.plain(stamps, values)
    for k in range(len(stamps)):
        step = int(stamps[k]) - gate.last_ns
        plain = 0 < step <= MAX_GAP_NS and abs(values[k, 4]) < LIMIT
        assert plain == (k < count)
        if not plain:
            break
        assert gate.refusal(int(stamps[k]), values[k]) is None
        gate.went_on(int(stamps[k]))


def stamps_of(given) -> list[int]:
    """Return stamps of which most follow each other, and some are at the ends of all numbers."""
    found: list[int] = []
    for start, step, number in given:
        after = found[-1] + step if found and number == 1.0 else start
        found.append(min(max(after, int(ENDS.min)), int(ENDS.max)))
    return found
