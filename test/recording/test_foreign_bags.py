"""Bags of other programs: ROS 1, without metadata, cut off, with the two halves on two topics."""

import numpy as np
import pytest

from dualfoot_ros.core import Increments, RecordingError
from dualfoot_ros.inspection import check_usable
from dualfoot_ros.recording import Recording, find_topics, list_topics, read_bag, write_bag

from .foreign import cut, ros1_bag, ros2_bag
from .samples import moving, recording

AT_REST = np.array([1.0, 2.0, 9.8])


@pytest.fixture
def feet():
    """Return samples of both feet by the usual topics."""
    return {
        "/left/imu/data_raw": moving(1, count=300),
        "/right/imu/data_raw": moving(2, count=300),
    }


def test_a_bag_of_ros_1_is_read_to_the_bit(tmp_path, feet):
    path = ros1_bag(tmp_path / "walk.bag", feet)
    read = read_bag(path)
    for foot, series in zip(("left", "right"), feet.values(), strict=True):
        assert np.array_equal(read.imu(foot).stamp_ns, series.stamp_ns)
        assert np.array_equal(read.imu(foot).specific_force, series.specific_force)
        assert np.array_equal(read.imu(foot).angular_rate, series.angular_rate)
    assert read.left_frame == "imu"
    assert read.cut == ""
    assert list_topics(path)["/left/imu/data_raw"].messages == 300


def test_a_bag_of_ros_1_says_what_its_samples_are(tmp_path, feet):
    path = ros1_bag(tmp_path / "walk.bag", feet, {"/left/imu/increments": "averaged"})
    read = read_bag(path)
    assert (read.left.increments, read.right.increments) == (Increments.AVERAGED, None)


def test_a_bag_of_ros_1_that_is_none_is_a_sentence(tmp_path):
    (tmp_path / "walk.bag").write_bytes(b"#ROSBAG V2.0\n" + bytes(50))
    with pytest.raises(RecordingError, match="damaged or cut off, and nothing"):
        read_bag(tmp_path / "walk.bag")


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_folder_without_metadata_is_read_by_its_file(tmp_path, storage):
    path = write_bag(tmp_path / "walk", recording(), storage=storage)
    (path / "metadata.yaml").unlink()
    read = read_bag(path)
    assert np.array_equal(read.left.specific_force, recording().left.specific_force)
    assert read.reference.length_m == 12.5


def test_several_files_without_metadata_follow_each_other_by_their_numbers(tmp_path):
    whole = moving(1, count=60, stand=20)
    folder = tmp_path / "walk"
    folder.mkdir()
    for k, part in enumerate(np.split(np.arange(60), [10, 20, 30, 40, 50])):
        bag = write_bag(tmp_path / f"part_{k}", Recording(whole[part]))
        (bag / f"part_{k}.mcap").rename(folder / f"walk_{8 + k}.mcap")
    assert np.array_equal(read_bag(folder).left.stamp_ns, whole.stamp_ns)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("metadata", [True, False])
@pytest.mark.parametrize("share", [0.3, 0.7, 0.95])
def test_a_bag_that_was_cut_off_is_read_as_far_as_it_goes_and_that_is_said(
    tmp_path, storage, metadata, share
):
    written = recording()
    path = cut(write_bag(tmp_path / "walk", written, storage=storage), share)
    if not metadata:
        (path / "metadata.yaml").unlink()
    read = read_bag(path)
    count = len(read.left)
    assert (share - 0.2) * len(written.left) < count <= len(written.left)
    assert np.array_equal(read.left.specific_force, written.left.specific_force[:count])
    assert "cut off" in read.cut
    assert "cut_off" in {finding.kind for finding in check_usable(read)} or share < 0.5


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_of_which_nothing_is_left_is_a_sentence(tmp_path, storage):
    path = cut(write_bag(tmp_path / "walk", recording(), storage=storage), 0.005)
    with pytest.raises(RecordingError, match="nothing of it can be read"):
        read_bag(path)


def test_uncompressed_and_compressed_files_are_cut_alike(tmp_path):
    series = moving(1, count=400)
    path = cut(ros2_bag(tmp_path / "plain", {"/left/imu/data_raw": series}), 0.6)
    read = read_bag(path).left
    assert 200 < len(read) < 260
    assert np.array_equal(read.stamp_ns, series.stamp_ns[: len(read)])


def test_an_accelerometer_and_a_gyro_on_two_topics_are_joined_at_the_stamps_of_the_gyro(tmp_path):
    rng = np.random.default_rng(0)
    gyro_ns = 10**18 + np.arange(400) * 5_000_000
    force_ns = 10**18 + 1_000_000 + np.arange(200) * 10_000_000
    force = np.column_stack([1e-9 * (force_ns - 10**18)] * 3) + AT_REST  # grows in time
    rate = rng.normal(size=(400, 3))
    topics = {"/left/accel": (force_ns, force), "/left/gyro": (gyro_ns, rate)}
    path = ros2_bag(tmp_path / "split", topics)
    found = read_bag(path, topics=find_topics(path).topics).left
    assert np.array_equal(found.stamp_ns, gyro_ns[1:399])  # where the other is known, too
    assert np.array_equal(found.angular_rate, rate[1:399])
    expected = np.column_stack([1e-9 * (found.stamp_ns - 10**18)] * 3) + AT_REST
    assert np.allclose(found.specific_force, expected)


def test_nothing_is_interpolated_across_a_hole_of_the_accelerometer(tmp_path):
    gyro_ns = 10**18 + np.arange(400) * 10_000_000
    kept = np.r_[0:100, 150:400]
    force = np.tile([0.0, 0.0, 9.8], (len(kept), 1))
    topics = {"/left/accel": (gyro_ns[kept], force), "/left/gyro": (gyro_ns, np.ones((400, 3)))}
    path = ros2_bag(tmp_path / "split", topics)
    found = read_bag(path, topics=find_topics(path).topics).left
    assert np.array_equal(found.stamp_ns, gyro_ns[kept])


def test_equal_stamps_on_two_topics_are_joined_to_the_bit(tmp_path):
    series = moving(3, count=200)
    topics = {
        "/imu_left/acceleration": (series.stamp_ns, series.specific_force),
        "/imu_left/angular_velocity": (series.stamp_ns, series.angular_rate),
    }
    path = ros2_bag(tmp_path / "split", topics, storage="sqlite3")
    found = read_bag(path, topics=find_topics(path).topics).left
    assert np.array_equal(found.specific_force, series.specific_force)
    assert np.array_equal(found.angular_rate, series.angular_rate)


def test_a_damaged_chunk_without_an_index_is_told(tmp_path):
    path = write_bag(tmp_path / "walk", recording())
    (file,) = path.glob("*.mcap")
    raw = bytearray(file.read_bytes())
    raw[len(raw) // 2 : len(raw) // 2 + 40] = bytes(40)
    del raw[-20:]  # and with it the index
    file.write_bytes(raw)
    read = read_bag(path)
    assert 0 < len(read.left) < len(recording().left)
    assert "'walk.mcap' is damaged; the" in read.cut
