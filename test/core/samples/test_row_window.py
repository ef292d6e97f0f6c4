"""Rows that come and go: always the array of those that are there."""

from collections import deque

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.samples.row_window import RowWindow


@given(st.lists(st.sampled_from(["append", "append", "drop_first", "clear", "hold"]), max_size=80))
def test_the_rows_are_those_of_a_queue_with_the_same_sums_to_the_bit(steps):
    window, queue, numbers = RowWindow(3), deque(), np.random.default_rng(1)
    for step in steps:
        row = numbers.normal(size=3).tolist()
        if step == "append":
            window.append(row)
            queue.append(row)
        elif step == "clear":
            window.clear()
            queue.clear()
        elif step == "hold":
            held = numbers.normal(size=(5, 3))
            window.hold(held)
            queue = deque(held.tolist())
        elif queue:
            window.drop_first()
            queue.popleft()
        found, wanted = window.rows(), np.reshape(list(queue), (-1, 3))
        assert found.tolist() == wanted.tolist()
        assert found.sum(axis=0).tolist() == wanted.sum(axis=0).tolist()
        assert found[:, 1].sum() == wanted[:, 1].sum()


def test_memory_does_not_grow_with_time():
    window = RowWindow(2)
    for k in range(10_000):
        window.append((k, -k))
        if k >= 100:
            window.drop_first()
    assert window.rows()[:, 0].tolist() == list(range(9_900, 10_000))
    assert len(window._memory) <= 512
