"""What is calculated block by block has the bits of numpy on the whole."""

import numpy as np
import pytest

from dualfoot_ros.core import picked, row_blocks, row_distances, row_lengths, unwrapped_angles
from dualfoot_ros.core.samples import by_block


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch):
    """Let some hundred rows be many blocks, the last one shorter."""
    monkeypatch.setattr(by_block, "BLOCK", 64)


@pytest.mark.parametrize("count", [0, 1, 63, 64, 65, 300])
def test_blocks_cover_all_rows_once_and_in_order(count):
    assert [k for part in row_blocks(count) for k in range(part.start, part.stop)] == [
        *range(count)
    ]


@pytest.mark.parametrize("count", [0, 1, 65, 300])
def test_lengths_and_distances_are_those_of_the_whole(count):
    one, other = np.random.default_rng(1).normal(size=(2, count, 3))
    assert np.array_equal(row_lengths(one), np.linalg.norm(one, axis=1))
    assert np.array_equal(row_lengths(one[:, :2]), np.linalg.norm(one[:, :2], axis=1))
    assert np.array_equal(row_distances(one, other), np.linalg.norm(one - other, axis=1))


@pytest.mark.parametrize("often", [0.0, 0.02, 1.0])
def test_angles_are_unwrapped_as_numpy_does(often):
    rng = np.random.default_rng(2)
    angles = np.cumsum(rng.normal(scale=0.3, size=500))
    angles += 2.0 * np.pi * np.cumsum(rng.choice([-1, 1], 500) * (rng.random(500) < often))
    angles[100], angles[101], angles[200:203] = 0.0, np.pi, (-np.pi, np.pi, 0.0)
    assert np.array_equal(unwrapped_angles(angles), np.unwrap(angles))
    angles[300] = np.nan
    assert np.array_equal(unwrapped_angles(angles), np.unwrap(angles), equal_nan=True)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_angles_are_as_they_are(count):
    angles = np.array([1.0, 9.0])[:count]
    assert np.array_equal(unwrapped_angles(angles), np.unwrap(angles))


def test_rows_are_picked_as_by_an_index_and_the_place_of_the_rows_may_rest_meanwhile(monkeypatch):
    rests: list[int] = []
    monkeypatch.setattr(by_block, "FEW", 10)
    monkeypatch.setattr(by_block, "rest", lambda: rests.append(1))
    rows = np.random.default_rng(3).normal(size=(300, 3))
    at = np.random.default_rng(4).integers(0, 300, 25)
    assert np.array_equal(picked(rows, at), rows[at])
    assert np.array_equal(picked(rows[:, 2], at), rows[at, 2])
    assert np.array_equal(picked(rows, slice(5, 9)), rows[5:9])
    assert len(rests) == 6
