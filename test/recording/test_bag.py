"""Bags: what is written comes back, what is broken is said, nothing is left half-written."""

import shutil
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from dualfoot_ros.core import ImuSeries, Increments
from dualfoot_ros.recording import (
    Recording,
    RecordingError,
    Topics,
    list_topics,
    read_bag,
    write_bag,
)
from dualfoot_ros.recording.topics import FootTopics

from .samples import moving, recording

STORE = get_typestore(Stores.ROS2_JAZZY)


def same(a, b):
    return all(
        np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True)
        for name in ("stamp_ns", "specific_force", "angular_rate")
    )


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_recording_comes_back_from_its_bag_to_the_bit(tmp_path, storage):
    written = recording()
    write_bag(tmp_path / "walk", written, storage=storage)
    read = read_bag(tmp_path / "walk")
    assert same(read.left, written.left)
    assert same(read.right, written.right)
    assert np.array_equal(read.left.magnetic_field, written.left.magnetic_field)
    assert read.right.magnetic_field is None
    for foot in ("left", "right"):
        assert np.array_equal(read.truth(foot).position, written.truth(foot).position)
        assert np.array_equal(read.truth(foot).quaternion, written.truth(foot).quaternion)
        assert np.allclose(read.truth(foot).velocity, written.truth(foot).velocity, atol=1e-12)
    assert np.array_equal(read.reference.markers["right"], written.reference.markers["right"])
    assert read.reference.closed_loop
    assert read.reference.length_m == 12.5
    assert read.notes == {"source": "made up"}


@settings(deadline=None, max_examples=20)
@given(
    st.lists(st.integers(0, 2**31 * 10**9 - 1), min_size=1, max_size=30),
    st.sampled_from(["mcap", "sqlite3"]),
)
def test_samples_keep_their_order_and_stamps_even_when_these_are_in_disorder(
    tmp_path_factory, stamps, storage
):
    values = np.random.default_rng(0).normal(size=(2, len(stamps), 3))
    values[0, 0, 0] = np.nan
    left = ImuSeries(np.array(stamps), values[0], values[1])
    path = write_bag(tmp_path_factory.mktemp("bag") / "b", Recording(left), storage=storage)
    read = read_bag(path)
    assert same(read.left, left)
    assert read.right is None


def test_a_single_file_of_a_bag_can_be_read_by_itself(tmp_path):
    write_bag(tmp_path / "walk", recording())
    assert same(read_bag(tmp_path / "walk" / "walk.mcap").right, recording().right)


def test_topics_with_other_names_are_read_and_written(tmp_path):
    topics = Topics(left=FootTopics("/imu_l", "/mag_l", "/truth_l", "l", "foot_l"))
    write_bag(tmp_path / "walk", recording(), topics=topics)
    assert "/imu_l" in list_topics(tmp_path / "walk")
    assert read_bag(tmp_path / "walk").left is None
    assert same(read_bag(tmp_path / "walk", topics=topics).left, recording().left)


@pytest.mark.parametrize("kind", [None, *Increments])
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_says_what_its_samples_are(tmp_path, kind, storage):
    whole = recording()
    left = replace(whole.left, increments=kind)
    write_bag(tmp_path / "walk", replace(whole, left=left), storage=storage)
    read = read_bag(tmp_path / "walk")
    assert read.left.increments is kind
    assert read.right.increments is None
    listed = list_topics(tmp_path / "walk")
    assert ("/left/imu/increments" in listed) is (kind is not None)


def test_what_the_samples_are_goes_with_their_topic(tmp_path):
    left = replace(recording().left, increments=Increments.SAMPLED)
    write_bag(tmp_path / "walk", Recording(left, recording().right))
    default = Topics()
    swapped = Topics(
        left=replace(default.left, imu=default.right.imu),
        right=replace(default.right, imu=default.left.imu),
    )
    read = read_bag(tmp_path / "walk", topics=swapped)
    assert (read.left.increments, read.right.increments) == (None, Increments.SAMPLED)


@pytest.mark.parametrize(
    ("imu", "beside"),
    [
        ("/left/imu/data_raw", "/left/imu/increments"),
        ("/a/data", "/a/increments"),
        ("/imu/left", "/imu/left/increments"),
        ("/imu_l", "/imu_l/increments"),
    ],
)
def test_the_feet_never_share_the_topic_that_says_what_their_samples_are(imu, beside):
    assert FootTopics(imu, "", "", "", "").increments == beside


def test_a_player_latches_what_the_samples_are(tmp_path):
    left = replace(recording().left, increments=Increments.AVERAGED)
    write_bag(tmp_path / "walk", Recording(left))
    with Reader(tmp_path / "walk") as reader:
        (qos,) = reader.topics["/left/imu/increments"].connections[0].ext.offered_qos_profiles
        (first, *_) = (connection.topic for connection, _, _ in reader.messages())
    assert qos.durability.name == "TRANSIENT_LOCAL"
    assert first == "/left/imu/increments"


def said_bag(path, text, name="/left/imu/increments", kind="std_msgs/msg/String"):
    """Write a bag that says ``text`` on a topic, in the type ``kind``."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connection = writer.add_connection(name, kind, typestore=STORE)
        message = STORE.types[kind](data=text)
        writer.write(connection, 10**9, STORE.serialize_cdr(message, kind))


def test_a_kind_that_is_none_is_refused_with_the_topic_and_what_is_allowed(tmp_path):
    said_bag(tmp_path / "walk", "smooth")
    with pytest.raises(
        RecordingError,
        match="'/left/imu/increments' says 'smooth'; allowed is one of compensated, averaged",
    ):
        read_bag(tmp_path / "walk")


def test_a_topic_of_that_name_and_another_type_says_nothing(tmp_path):
    said_bag(tmp_path / "walk", 1.0, kind="std_msgs/msg/Float64")
    assert read_bag(tmp_path / "walk").left is None


def foreign_bag(path, frames, topic="/left/imu/data_raw"):
    """Write a bag as another program might: one message for each frame id."""
    types = STORE.types
    time, header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    vector, quaternion = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    imu = types["sensor_msgs/msg/Imu"]
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connection = writer.add_connection(topic, imu.__msgtype__, typestore=STORE)
        for k, frame in enumerate(frames):
            message = imu(
                header=header(stamp=time(sec=5, nanosec=k), frame_id=frame),
                orientation=quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
                orientation_covariance=np.zeros(9),
                angular_velocity=vector(x=1.0 + k, y=2.0, z=3.0),
                angular_velocity_covariance=np.zeros(9),
                linear_acceleration=vector(x=4.0, y=5.0, z=6.0 + k),
                linear_acceleration_covariance=np.zeros(9),
            )
            writer.write(connection, k, STORE.serialize_cdr(message, imu.__msgtype__))


@pytest.mark.parametrize("frames", [["imu"] * 4, ["", "a", "ab", "a_longer_frame"]])
def test_messages_of_one_or_of_several_layouts_give_the_same_numbers(tmp_path, frames):
    foreign_bag(tmp_path / "b", frames)
    left = read_bag(tmp_path / "b").left
    assert left.stamp_ns.tolist() == [5_000_000_000 + k for k in range(4)]
    assert left.angular_rate.tolist() == [[1.0 + k, 2.0, 3.0] for k in range(4)]
    assert left.specific_force.tolist() == [[4.0, 5.0, 6.0 + k] for k in range(4)]


def test_what_is_written_decodes_as_a_ros_message(tmp_path):
    from rosbags.rosbag2 import Reader

    write_bag(tmp_path / "walk", recording())
    with Reader(tmp_path / "walk") as reader:
        for connection, _, data in reader.messages():
            message = STORE.deserialize_cdr(data, connection.msgtype)
            if connection.topic == "/right/imu/data_raw":
                break
    assert message.header.frame_id == "right_imu"
    assert message.orientation_covariance[0] == -1.0
    assert message.linear_acceleration.z == recording().right.specific_force[0, 2]


def test_a_topic_of_another_type_is_refused_by_name(tmp_path):
    foreign_bag(tmp_path / "b", ["imu"], topic="/left/ground_truth")
    with pytest.raises(RecordingError, match="'/left/ground_truth' holds sensor_msgs/msg/Imu"):
        read_bag(tmp_path / "b")


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("share", [0.0, 0.01])
def test_a_bag_that_was_cut_off_is_a_sentence(tmp_path, storage, share):
    path = write_bag(tmp_path / "walk", recording(), storage=storage)
    (file,) = [f for f in path.iterdir() if f.suffix in (".mcap", ".db3")]
    file.write_bytes(file.read_bytes()[: int(file.stat().st_size * share)])
    with pytest.raises(RecordingError, match="damaged or cut off"):
        read_bag(path)


@settings(deadline=None, max_examples=40)
@given(st.data())
def test_a_bag_with_any_bytes_broken_reads_or_is_refused_but_never_crashes(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("broken")
    path = write_bag(folder / "b", Recording(moving(0, count=50, stand=20)))
    file = path / data.draw(st.sampled_from(["b.mcap", "metadata.yaml"]))
    raw = bytearray(file.read_bytes())
    for _ in range(data.draw(st.integers(1, 5))):
        raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    file.write_bytes(raw)
    sentence = ""
    try:
        read_bag(path)
    except RecordingError as error:
        sentence = str(error)
    finally:
        shutil.rmtree(folder)
    assert sentence == "" or str(path) in sentence or "topic" in sentence


def test_a_message_that_is_too_short_is_named_with_its_topic(tmp_path):
    with Writer(tmp_path / "b", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection(
            "/right/imu/data_raw", "sensor_msgs/msg/Imu", typestore=STORE
        )
        writer.write(connection, 0, b"\x00\x01\x00\x00\x05\x00")
    with pytest.raises(RecordingError, match="message 0 of topic '/right/imu/data_raw'"):
        read_bag(tmp_path / "b")


def test_what_is_no_bag_is_a_sentence_that_says_what_to_do(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "walk.csv").write_text("1,2")
    for path, sentence in [
        ("nothing", "there is no bag"),
        ("folder", "has no metadata.yaml"),
        ("walk.csv", "dualfoot import"),
    ]:
        with pytest.raises(RecordingError, match=sentence):
            read_bag(tmp_path / path)


def test_an_existing_bag_is_replaced_only_when_asked_to(tmp_path):
    path = write_bag(tmp_path / "walk", recording())
    with pytest.raises(RecordingError, match="exists already"):
        write_bag(path, Recording(moving(9)))
    assert same(read_bag(path).left, recording().left)
    write_bag(path, Recording(moving(9)), overwrite=True)
    assert same(read_bag(path).left, moving(9))
    assert [p.name for p in tmp_path.iterdir()] == ["walk"]


def test_a_folder_that_is_no_bag_is_never_replaced(tmp_path):
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_text("precious")
    with pytest.raises(RecordingError, match="not something this program wrote"):
        write_bag(tmp_path / "photos", recording(), overwrite=True)
    assert (tmp_path / "photos" / "cat.jpg").exists()


def test_a_write_that_fails_midway_leaves_nothing_behind(tmp_path):
    def give_up(share):
        if share > 0.5:
            raise KeyboardInterrupt

    long = moving(0, count=12000)
    with pytest.raises(KeyboardInterrupt):
        write_bag(tmp_path / "walk", Recording(long), progress=give_up)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("part", "sentence"),
    [
        (Recording(), "no sample to write"),
        (Recording(moving(start_ns=-5)), "stamp 0 for topic '/left/imu/data_raw' is -5 ns"),
        (Recording(moving(start_ns=2**62)), "shift the clock"),
    ],
)
def test_what_cannot_be_written_is_refused_before_anything_is(tmp_path, part, sentence):
    with pytest.raises(RecordingError, match=sentence):
        write_bag(tmp_path / "walk", part)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_storage_is_refused_with_the_known_ones(tmp_path):
    with pytest.raises(RecordingError, match="storage is 'tape'; allowed is one of mcap, sqlite3"):
        write_bag(tmp_path / "walk", recording(), storage="tape")


def test_progress_runs_from_nothing_to_all(tmp_path):
    seen = []
    path = write_bag(tmp_path / "w", Recording(moving(count=9000)), progress=seen.append)
    read_bag(path, progress=seen.append)
    assert len(seen) > 4
    assert all(0.0 <= share <= 1.0 for share in seen)
