"""Bags on a stock ROS 2: read and written by rosbag2_py where rosbags is not installed.

The module is a stand-in with the interface of rosbag2_py that is used, over rosbags.
"""

import importlib.util
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from rosbags.rosbag2 import Reader, StoragePlugin, Writer

from dualfoot_ros.core import Increments, RecordingError
from dualfoot_ros.recording import read_bag, write_bag
from dualfoot_ros.recording.storage import bag_writer
from dualfoot_ros.recording.storage.rosbag2_py_source import Rosbag2PySource

from . import stepped
from .foreign import STORE, cut
from .samples import recording

STRING = "std_msgs/msg/String"


class SequentialReader:
    """Reader with the methods of rosbag2_py that are used here."""

    def open(self, storage, converter):
        assert (converter.input, converter.output) == ("", "")
        self.reader, self.wanted = Reader(storage.uri), None
        try:
            self.reader.open()
        except Exception as error:
            raise RuntimeError("No storage could be initialized") from error

    def get_metadata(self):
        topics = [
            SimpleNamespace(
                topic_metadata=SimpleNamespace(name=c.topic, type=c.msgtype),
                message_count=c.msgcount,
            )
            for c in self.reader.connections
        ]
        custom = dict(self.reader.storage.metadata.custom or {})
        return SimpleNamespace(
            topics_with_message_count=topics,
            custom_data=custom,
            relative_file_paths=[str(self.file().path)],
        )

    def file(self):
        (file,) = getattr(self.reader.storage, "storages", [self.reader.storage])
        return file

    def set_read_order(self, order):
        assert order == ("file", False)
        self.read = self.file().messages_scan  # that of MCAP; sqlite3 has no such order

    def set_filter(self, wanted):
        self.messages = self.read([c for c in self.file().connections if c.topic in wanted.topics])
        self.next = next(self.messages, None)

    def has_next(self):
        return self.next is not None

    def read_next(self):
        (connection, log_ns, data), self.next = self.next, next(self.messages, None)
        return connection.topic, data, log_ns


class SequentialWriter:
    """Writer with the methods of rosbag2_py that are used here."""

    def open(self, storage, converter):
        assert (converter.input, converter.output) == ("cdr", "cdr")
        plugin = StoragePlugin[storage.storage_id.upper()]
        self.writer = Writer(storage.uri, version=9, storage_plugin=plugin)
        for key, value in storage.custom_data.items():
            self.writer.set_custom_data(key, value)
        self.writer.open()
        self.keys = {}

    def create_topic(self, topic):
        assert topic.serialization_format == "cdr"
        profiles = getattr(topic, "offered_qos_profiles", [])
        assert [profile.said for profile in profiles] == (
            [(1, "reliable", "transient_local")] if topic.type == STRING else []
        )
        key = self.writer.add_connection(topic.name, topic.type, typestore=STORE)
        self.keys[topic.name] = key

    def write(self, topic, data, log_ns):
        assert isinstance(data, bytes)
        self.writer.write(self.keys[topic], log_ns, data)

    def close(self):
        self.writer.close()


class QoS:
    """Profile with the methods of rosbag2_py's that are used here."""

    def __init__(self, history_depth):
        self.said = (history_depth,)

    def reliable(self):
        self.said += ("reliable",)
        return self

    def transient_local(self):
        self.said += ("transient_local",)
        return self


class WriterWithoutClose(SequentialWriter):
    """An older writer, which closes with its last reference."""

    close = property()

    def __del__(self):
        self.writer.close()


def storage_options(uri, storage_id=""):
    return SimpleNamespace(uri=uri, storage_id=storage_id, custom_data={})


@pytest.fixture
def stock_ros(monkeypatch):
    """Hide rosbags from the package, and give it rosbag2_py."""
    module = SimpleNamespace(
        SequentialReader=SequentialReader,
        SequentialWriter=SequentialWriter,
        StorageOptions=storage_options,
        ConverterOptions=lambda given, wanted: SimpleNamespace(input=given, output=wanted),
        StorageFilter=SimpleNamespace,
        ReadOrder=lambda sort_by, reverse: (sort_by, reverse),
        ReadOrderSortBy=SimpleNamespace(File="file"),
        TopicMetadata=SimpleNamespace,
    )
    monkeypatch.setitem(sys.modules, "rosbag2_py", module)
    monkeypatch.setitem(sys.modules, "rosbag2_py._storage", SimpleNamespace(QoS=QoS))
    hide(monkeypatch, "rosbags")
    return module


def hide(monkeypatch, *names):
    """Let packages be found as installed ones are, but for ``names``."""
    find = importlib.util.find_spec

    def find_others(name, package=None):
        if name in names:
            return None
        if name == "rosbag2_py":
            return object() if name in sys.modules else None
        return find(name, package)

    monkeypatch.setattr(bag_writer.util, "find_spec", find_others)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
@pytest.mark.parametrize("writer", [SequentialWriter, WriterWithoutClose])
def test_a_recording_comes_back_to_the_bit(tmp_path, stock_ros, storage, writer):
    stock_ros.SequentialWriter = writer
    made = recording()
    written = replace(made, left=replace(made.left, increments=Increments.SAMPLED))
    path = write_bag(tmp_path / "walk", written, storage=storage)
    read = read_bag(path)
    for foot in ("left", "right"):
        assert np.array_equal(read.imu(foot).stamp_ns, written.imu(foot).stamp_ns)
        assert np.array_equal(read.imu(foot).angular_rate, written.imu(foot).angular_rate)
    assert (read.left.increments, read.right.increments) == (Increments.SAMPLED, None)
    assert read.notes == {"source": "made up"}
    assert read.reference.length_m == 12.5


def test_it_is_this_reader_that_reads(tmp_path, stock_ros):
    path = write_bag(tmp_path / "walk", recording())
    source = Rosbag2PySource(path)
    assert source.topics["/left/imu/data_raw"].messages == len(recording().left)
    assert {b.topic for b in source.blocks(["/left/pressure"])} == {"/left/pressure"}
    assert list(source.blocks(["/none"])) == []


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_order_is_that_of_the_recording_there_too(tmp_path, stock_ros, storage):
    stepped.assert_in_order(stepped.ros2(tmp_path / "walk", storage))


def test_a_cut_off_bag_is_read_as_far_as_it_goes_there_too(tmp_path, stock_ros):
    path = cut(write_bag(tmp_path / "walk", recording()), 0.5)
    assert 0 < len(read_bag(path).left) < len(recording().left)


def test_a_bag_of_ros_1_says_what_it_needs(tmp_path, stock_ros):
    (tmp_path / "walk.bag").write_bytes(b"#ROSBAG V2.0\n")
    with pytest.raises(RecordingError, match="needs the package rosbags: pip install rosbags"):
        read_bag(tmp_path / "walk.bag")


def test_without_either_library_one_is_asked_for(tmp_path, monkeypatch):
    path = write_bag(tmp_path / "walk", recording())
    hide(monkeypatch, "rosbags", "rosbag2_py")
    for use in (lambda: read_bag(path), lambda: write_bag(tmp_path / "new", recording())):
        with pytest.raises(RecordingError, match=r"pip install rosbags.*rosbag2_py"):
            use()
