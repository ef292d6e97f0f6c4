"""Files written many messages at once, read by rosbags and from the start."""

import numpy as np
import pytest
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from dualfoot_ros.recording.storage.bag_writer import new_bag
from dualfoot_ros.recording.storage.mcap_scan import McapScan

TOPICS = {"/left/imu": "sensor_msgs/msg/Imu", "/text": "std_msgs/msg/String"}
MESSAGES = 9000  # of 0 to 700 bytes: more than two chunks of 1 MiB


@pytest.fixture(scope="module")
def messages():
    """Return place in TOPICS, log time (with equal ones), and bytes of every message."""
    rng = np.random.default_rng(4)
    which = rng.integers(0, 2, MESSAGES)
    log_ns = np.sort(rng.integers(10**18, 10**18 + 10**6, MESSAGES))
    return which, log_ns, [rng.bytes(length) for length in rng.integers(0, 700, MESSAGES)]


def write(folder, messages, block, packed=True):
    which, log_ns, data = messages
    with new_bag(folder, "mcap", {"key": "value"}, packed=packed) as writer:
        keys = [
            writer.add_topic(*topic, latched_depth=k) for k, topic in enumerate(TOPICS.items())
        ]
        for start in range(0, MESSAGES, block):
            part = slice(start, start + block)
            writer.write_many(keys, which[part], log_ns[part], data[part])
    return folder


def write_by_rosbags(folder, messages):
    store = get_typestore(Stores.ROS2_JAZZY)
    writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        keys = [writer.add_connection(*topic, typestore=store) for topic in TOPICS.items()]
        for which, log_ns, data in zip(*messages, strict=True):
            writer.write(keys[which], int(log_ns), data)
    return folder


def content(folder, **span):
    with Reader(folder) as reader:
        facts = (reader.message_count, reader.start_time, reader.end_time, reader.duration)
        topics = [(c.topic, c.msgtype, c.msgdef, c.digest, c.msgcount) for c in reader.connections]
        return facts, topics, [(c.topic, t, data) for c, t, data in reader.messages(**span)]


@pytest.mark.parametrize("packed", [True, False])
def test_a_reader_finds_what_the_writer_of_rosbags_writes(tmp_path, messages, packed):
    ours = write(tmp_path / "ours", messages, 1000, packed)
    theirs = write_by_rosbags(tmp_path / "theirs", messages)
    assert content(ours) == content(theirs)
    middle = 10**18 + 5 * 10**5
    assert content(ours, start=middle) == content(theirs, start=middle)  # by the index of times


def test_the_bytes_do_not_depend_on_how_many_messages_come_at_once(tmp_path, messages):
    files = [
        write(tmp_path / str(block) / "bag", messages, block) / "bag.mcap"
        for block in (700, MESSAGES)
    ]
    assert files[0].read_bytes() == files[1].read_bytes()


def test_a_file_whose_end_is_missing_is_read_as_far_as_it_goes(tmp_path, messages):
    path = write(tmp_path / "bag", messages, 1000) / "bag.mcap"
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])
    found = {topic: [] for topic in TOPICS}
    for block in McapScan(path).blocks(TOPICS):
        found[block.topic] += zip(block.log_ns.tolist(), block.rows, strict=True)
    which, log_ns, data = messages
    assert MESSAGES // 3 < sum(map(len, found.values())) < MESSAGES
    for k, own in enumerate(found.values()):
        at = np.flatnonzero(which == k)[: len(own)]
        assert own == [(int(log_ns[i]), data[i]) for i in at]
