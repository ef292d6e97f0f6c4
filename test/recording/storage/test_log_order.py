"""Messages are in the order of their log times, but where the clock of the recorder was set."""

import numpy as np
import pytest

from dualfoot_ros.recording import read_logged
from dualfoot_ros.recording.storage.log_order import recorded_order

from .. import stepped

START_NS = 10**18
STEP_NS = 10_000_000
COUNT = 300


def logged():
    return START_NS + np.arange(COUNT) * STEP_NS


def order_of(log_ns):
    return recorded_order(log_ns, np.zeros(len(log_ns), dtype=np.int64)).tolist()


@pytest.mark.parametrize("by_s", [3600.0, 100.0, 1.0, 0.2])
def test_a_clock_that_was_set_back_leaves_the_order_of_the_file(by_s):
    log_ns = logged()
    log_ns[200:] -= round(by_s * 1e9)
    assert order_of(log_ns) == list(range(COUNT))


def test_a_clock_may_be_set_back_twice():
    log_ns = logged()
    log_ns[100:] -= 3_600_000_000_000
    log_ns[200:] -= 1_000_000_000
    assert order_of(log_ns) == list(range(COUNT))


def test_parts_that_stand_in_another_order_are_sorted():
    log_ns = np.roll(logged(), 120)
    assert order_of(log_ns) == np.argsort(log_ns).tolist()


def test_a_message_that_is_late_is_sorted():
    log_ns = logged()
    log_ns[200:203] -= 500_000_000
    assert order_of(log_ns) == np.argsort(log_ns, kind="stable").tolist()


def test_log_times_in_disorder_are_sorted():
    log_ns = np.random.default_rng(1).permutation(logged())
    assert order_of(log_ns) == np.argsort(log_ns).tolist()


def test_files_keep_their_order_and_each_has_its_own():
    files = np.repeat([0, 1], COUNT // 2)
    log_ns = logged()
    log_ns[COUNT // 2 :] -= 3_600_000_000_000
    log_ns[[3, 4]] = log_ns[[4, 3]]
    wanted = [0, 1, 2, 4, 3, *range(5, COUNT)]
    assert recorded_order(log_ns, files).tolist() == wanted


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_is_read_in_the_order_in_which_it_was_recorded(tmp_path, storage, compressed):
    stepped.assert_in_order(stepped.ros2(tmp_path / "bag", storage, compressed=compressed))


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_so_is_one_without_metadata(tmp_path, storage):
    bag = stepped.ros2(tmp_path / "bag", storage)
    (bag / "metadata.yaml").unlink()
    stepped.assert_in_order(bag)


def test_so_is_one_of_ros_1(tmp_path):
    stepped.assert_in_order(stepped.ros1(tmp_path / "bag.bag"))


def test_of_two_files_without_metadata_each_is_sorted_by_itself(tmp_path):
    (tmp_path / "bag").mkdir()
    for number in range(2):
        bag = stepped.ros2(tmp_path / str(number), "sqlite3")
        (bag / f"{number}.db3").rename(tmp_path / "bag" / f"bag_{number}.db3")
    recording, _ = read_logged(tmp_path / "bag")
    assert recording.left.stamp_ns.tolist() == stepped.log_times().tolist() * 2
