"""MCAP files by their chunks: the messages are those that come one by one, in the same order."""

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from dualfoot_ros.core import RecordingError
from dualfoot_ros.recording import cdr, read_bag, read_logged, write_bag
from dualfoot_ros.recording.open_bag import UNUSUAL as UNUSUAL_ERRORS
from dualfoot_ros.recording.open_bag import opened
from dualfoot_ros.recording.storage.bag_source import in_blocks
from dualfoot_ros.recording.storage.mcap_bag import McapBag
from dualfoot_ros.recording.storage.mcap_chunks import McapChunks
from dualfoot_ros.recording.storage.mcap_scan import CHUNK_HEAD, HEAD
from dualfoot_ros.recording.storage.rosbags_source import RosbagsSource
from dualfoot_ros.recording.topics import IMU_TYPE

from .samples import recording

TOPIC = "/left/imu/data_raw"


def messages_of(blocks):
    """Return the log times and bytes by topic; those of one file in the order of their times."""
    found = {}
    for block in blocks:
        rows = [(int(t), bytes(row)) for t, row in zip(block.log_ns, block.rows, strict=True)]
        found.setdefault(block.topic, []).extend(rows)
    return {topic: sorted(rows, key=lambda row: row[0]) for topic, rows in found.items()}


def test_an_ordinary_bag_says_the_same_as_through_the_library(tmp_path):
    bag = write_bag(tmp_path / "bag", recording())
    library = RosbagsSource(bag)
    with opened(bag) as own:
        assert isinstance(own, McapBag)
        assert list(own.topics.items()) == list(library.topics.items())
        assert own.custom == library.custom and own.custom
        found = messages_of(own.blocks(list(own.topics)))
    assert found == messages_of(in_blocks(library.messages(list(own.topics)))) and found
    library.close()


def test_the_rows_of_sqlite_are_those_that_the_library_gives(tmp_path):
    library = RosbagsSource(write_bag(tmp_path / "bag", recording(), storage="sqlite3"))
    topics = list(library.topics)
    found = messages_of(library.blocks(topics))
    assert found == messages_of(in_blocks(library.messages(topics))) and found
    library.close()


UNUSUAL = {
    "a newer version": ("version: 9", "version: 10"),
    "another storage": ("storage_identifier: mcap", "storage_identifier: sqlite3"),
    "compressed message by message": ("compression_mode: ''", "compression_mode: MESSAGE"),
    "another serialisation": ("serialization_format: cdr", "serialization_format: json"),
    "a file that is not there": ("- bag.mcap", "- other.mcap"),
    "no YAML": ("version: 9", "version: [9"),
    "a key too few": ("relative_file_paths", "paths"),
}


@pytest.mark.parametrize("change", UNUSUAL.values(), ids=UNUSUAL.keys())
def test_the_library_reads_an_unusual_bag_or_says_what_is_wrong(tmp_path, change):
    bag = write_bag(tmp_path / "bag", recording())
    metadata = bag / "metadata.yaml"
    before = metadata.read_text()
    metadata.write_text(before.replace(*change))
    assert metadata.read_text() != before
    with pytest.raises(UNUSUAL_ERRORS):
        McapBag(bag)


def test_a_file_that_does_not_begin_as_one_of_ros_2_is_left_to_the_library(tmp_path):
    bag = write_bag(tmp_path / "bag", recording())
    data = bytearray((bag / "bag.mcap").read_bytes())
    data[data.index(b"ros2")] = ord("x")
    (bag / "bag.mcap").write_bytes(data)
    with pytest.raises(ValueError, match="begin as a file of ROS 2"):
        McapBag(bag)


def disordered(path, log_ns, frames):
    """Write samples with these log times, and frames that may differ in length."""
    types = get_typestore(Stores.ROS2_JAZZY)
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection(TOPIC, IMU_TYPE, typestore=types)
        for k, (log, frame) in enumerate(zip(log_ns, frames, strict=True)):
            values = np.full((1, 37), float(k))
            row = cdr.encode(np.array([10**18 + k]), values, (frame,))
            writer.write(connection, log, row.tobytes())
    return path


@pytest.mark.parametrize("frames", [["imu"] * 4, ["imu", "a longer name", "imu", "x"]])
def test_messages_come_in_the_order_of_their_log_times(tmp_path, frames):
    bag = disordered(tmp_path / "bag", [30, 10, 20, 20], frames)
    found, logged = read_logged(bag)
    assert logged["left"].tolist() == [10, 20, 20, 30]
    assert found.left.angular_rate[:, 0].tolist() == [1.0, 2.0, 3.0, 0.0]


def test_a_chunk_that_cannot_be_decompressed_is_refused(tmp_path):
    bag = write_bag(tmp_path / "bag", recording())
    (file,) = bag.glob("*.mcap")
    place = McapChunks(file, 0)._chunks[0]
    data = bytearray(file.read_bytes())
    compressed = HEAD.size + CHUNK_HEAD.size + len("zstd") + 8
    data[place.start + compressed] ^= 0xFF
    file.write_bytes(data)
    with pytest.raises(RecordingError, match="is damaged behind 0 messages"):
        read_bag(bag)


def test_a_file_without_an_index_has_no_chunks_to_read(tmp_path):
    file = tmp_path / "none.mcap"
    file.write_bytes(bytes(100))
    with pytest.raises(ValueError, match="no summary"):
        McapChunks(file, 0)
