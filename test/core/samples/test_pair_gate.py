"""The short way of a pair that just follows takes what the long way takes, and nothing else."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core.samples.pair_gate import MAX_GAP_NS, PairGate

PERIOD_NS = 10_000_000
LONGEST_NS = 17_000_000
steps = st.sampled_from(
    (PERIOD_NS, 0, -PERIOD_NS, LONGEST_NS, LONGEST_NS + 1, 11 * 10**9, -(10**10))
)
numbers = st.sampled_from((1.0, 1.0, 1.0, 499.0, 600.0, np.nan, np.inf))


@given(st.lists(st.tuples(steps, numbers), min_size=2, max_size=30))
@settings(max_examples=100, deadline=None)
def test_the_short_way_is_the_long_one(pairs):
    """Asked for the interval first, a gate decides as one that is only asked what it refuses."""
    short, long = PairGate(), PairGate()
    stamp = 10**12
    for step, number in pairs:
        stamp += step
        values = np.zeros(12)
        values[3] = number
        last_ns = long.last_ns
        refused = long.refusal(stamp, values)
        dt_ns = short.interval(stamp, values, LONGEST_NS)
        if dt_ns:
            assert refused is None
            assert last_ns is not None
            assert dt_ns == stamp - last_ns <= LONGEST_NS < MAX_GAP_NS
        else:
            follows = last_ns is not None and 0 < stamp - last_ns <= LONGEST_NS
            assert not (follows and np.isfinite(number) and number < 500.0)
            assert short.refusal(stamp, values) == refused
            if refused is None:
                short.step(stamp)
        if refused is None:
            long.step(stamp)
        assert vars(short) == vars(long)
