"""Covariances of a walk are the arrays they were made of, whichever way they are kept."""

import numpy as np
import pytest

from dualfoot_ros.core import Covariances, about_z
from dualfoot_ros.core.results.covariances import UPPER

COUNT, WHOLE = 40, 7


def matrices() -> np.ndarray:
    roots = np.random.default_rng(1).normal(size=(COUNT, 3, 3))
    found = roots @ roots.transpose(0, 2, 1)
    found = np.triu(found) + np.triu(found, 1).transpose(0, 2, 1)
    found[:WHOLE, 1, 0] += 1e-17  # as a turn rounds them
    return found


def kept(array: np.ndarray) -> Covariances:
    return Covariances(array[:WHOLE], array[WHOLE:].reshape(-1, 9)[:, UPPER])


KEYS = {
    "all": slice(None),
    "neighbours": slice(3, 20),
    "from the end": slice(-9, None),
    "every third": slice(None, None, 3),
    "nothing": slice(5, 5),
    "one": 12,
    "the last": -1,
    "some": np.array([0, 6, 7, 30, 30]),
    "a mask": np.arange(COUNT) % 4 == 1,
    "variances": (slice(None), 2, 2),
    "one cell of some": (np.array([2, 25]), 0, 1),
    "blocks": (slice(2, 30), slice(None, 2), slice(None, 2)),
    "rows of one": (9, 1),
}


@pytest.mark.parametrize("key", KEYS.values(), ids=KEYS.keys())
def test_an_index_takes_what_it_takes_of_the_array(key):
    array = matrices()
    assert np.array_equal(kept(array)[key], array[key])
    assert kept(array)[key].shape == array[key].shape
    assert np.array_equal(Covariances.of(array)[key], array[key])


@pytest.mark.parametrize("keep", [slice(2, 5), slice(3, 20), slice(10, None), KEYS["a mask"]])
def test_what_is_cut_is_that_of_the_array(keep):
    array, turn = matrices(), about_z(0.7)
    assert np.array_equal(kept(array).cut(keep), array[keep])
    turned = turn @ array @ turn.T
    assert np.array_equal(kept(array).turned(turn).cut(keep), turned[keep])


def test_a_turn_is_calculated_when_it_is_looked_at():
    array, first, second = matrices(), about_z(0.7), about_z(-2.0)
    turned = first @ array @ first.T
    assert np.array_equal(kept(array).turned(first), turned)
    assert np.array_equal(kept(array).turned(first)[11], turned[11])
    assert np.array_equal(kept(array).turned(first).turned(second), second @ turned @ second.T)


def test_they_are_calculated_with_as_arrays():
    array = matrices()
    assert np.array_equal(kept(array) + kept(array), array + array)
    assert np.array_equal(kept(array) / 2 - array, array / 2 - array)
    assert np.array_equal(np.sqrt(np.abs(kept(array))), np.sqrt(np.abs(array)))


def test_of_some_epochs_only_those_are_known():
    array = matrices()
    few = kept(array).only(np.array([1, 4, len(array) - 1]))
    expected = np.full(array.shape, np.nan)
    expected[[1, 4, -1]] = array[[1, 4, -1]]
    assert np.array_equal(np.asarray(few), expected, equal_nan=True)
    assert np.array_equal(few[:, 2, 2], expected[:, 2, 2], equal_nan=True)
    assert np.array_equal(few[[4, 0, 1]], expected[[4, 0, 1]], equal_nan=True)
    assert few.shape == array.shape


@pytest.mark.parametrize("keep", [slice(2, 7), np.arange(COUNT) % 3 != 2])
def test_those_of_some_epochs_can_be_cut_and_turned(keep):
    array, turn = matrices(), about_z(0.4)
    few = kept(array).only(np.array([1, 4, 6]))
    whole = kept(array).turned(turn)
    found = np.asarray(few.turned(turn).cut(keep))
    there = np.isin(np.arange(len(array)), [1, 4, 6])[keep]
    assert np.array_equal(found[there], np.asarray(whole.cut(keep))[there])
    assert there.any() and np.isnan(found[~there]).all()
