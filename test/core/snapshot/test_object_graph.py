"""Objects as plain values and arrays, and back."""

import json
from collections import Counter, deque
from functools import partial
from urllib.parse import urlsplit

import numpy as np
import pytest

from dualfoot_ros.core import SnapshotError, TrackerConfig
from dualfoot_ros.core.results.payloads import DistanceLimit
from dualfoot_ros.core.rotation import about_z
from dualfoot_ros.core.snapshot.object_graph import Decoder, Encoder, resolve


def again(item):
    """Return an item encoded, written as JSON, read and decoded."""
    encoder = Encoder()
    root = json.loads(json.dumps(encoder.encode(item)))
    objects = json.loads(json.dumps(encoder.objects))
    return Decoder(objects, [a.copy() for a in encoder.arrays]).decode(root)


@pytest.mark.parametrize(
    "item",
    [
        None, True, 3, -0.0, 1e-308, float("inf"), "text", [1, [2.5, "a"]], (1, (2,)),
        {"a": 1, (1, "b"): [2]}, Counter(a=3), DistanceLimit(0.2, 0.1),
    ],
)  # fmt: skip
def test_plain_values_come_back_equal_and_of_the_same_type(item):
    found = again(item)
    assert found == item
    assert type(found) is type(item)
    assert repr(found) == repr(item)


def test_a_deque_keeps_its_length():
    found = again(deque([1, 2], maxlen=5))
    assert found == deque([1, 2]) and found.maxlen == 5


def test_numbers_of_numpy_stay_numbers_of_numpy():
    found = again([np.float64(0.1), np.int64(3)])
    assert [type(each) for each in found] == [np.float64, np.int64]


def test_what_is_one_object_stays_one():
    array = np.arange(3.0)
    found = again([array, {"same": array}])
    assert found[0] is found[1]["same"]
    found[0][0] = 7.0
    assert found[1]["same"][0] == 7.0


def test_an_object_may_refer_to_itself():
    items = [1]
    items.append(items)
    found = again(items)
    assert found[1] is found


def test_functions_of_the_core_come_back_with_what_they_were_given():
    found = again(partial(about_z, 0.3))
    assert np.array_equal(found(), about_z(0.3))


def test_a_configuration_comes_back_equal():
    config = TrackerConfig(method="idc")
    assert again(config) == config


@pytest.mark.parametrize("path", ["os:system", "dualfoot_ros.cli.main:main", "builtins:eval"])
def test_nothing_outside_of_the_core_is_called_or_made(path):
    with pytest.raises(SnapshotError, match="no part of a tracker"):
        resolve(path)


@pytest.mark.parametrize("item", [object(), open, lambda: 3, {1, 2}, urlsplit("a")])
def test_what_cannot_be_kept_is_refused(item):
    with pytest.raises(SnapshotError):
        again(item)
