"""A recording that its disk has no room for is kept up to there, and stops no node."""

import errno

from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu

from dualfoot_ros.nodes.playback.recorder import RecorderNode
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.recording import read_bag

COUNT = 5000  # some MB: chunks are written, and one is not full yet


def full(*_):
    raise OSError(errno.ENOSPC, "No space left on device")


def recorder(bench, path):
    topics = {f"{foot}/imu/data_raw": (Imu, qos.sensor(10)) for foot in ("left", "right")}
    return bench.add(lambda **options: RecorderNode(path, topics, **options))


def record(node):
    """Record messages of both feet, without a publisher."""
    message = Imu()
    for k in range(COUNT):
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(k * 10_000_000, 10**9)
        for each in node._inputs:
            each.callback(serialize_message(message))


def test_what_was_written_before_the_disk_was_full_stays_and_is_read(bench, tmp_path, capfd):
    node = recorder(bench, tmp_path / "walk")
    record(node)
    assert node.recorded == 2 * COUNT
    node._writer.write = full
    record(node)
    node.destroy_node()
    assert [each.name for each in tmp_path.iterdir()] == ["walk"]
    kept = read_bag(tmp_path / "walk")
    assert 0.5 * COUNT < len(kept.left) < COUNT
    assert "cut off" in kept.cut
    error = capfd.readouterr().err
    assert error.count("nothing more is recorded to") == 1
    assert "walk': No space left on device; what was written until now stays there" in error


def test_a_bag_that_cannot_be_closed_stays_as_it_is(bench, tmp_path, capfd):
    node = recorder(bench, tmp_path / "walk")
    record(node)
    node._writer._writer.storage._put_summary = full
    node.destroy_node()
    assert len(read_bag(tmp_path / "walk").left) == COUNT
    assert "nothing more is recorded to" in capfd.readouterr().err
