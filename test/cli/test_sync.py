"""``dualfoot sync``: what it finds, what it writes, what it refuses."""

import json
from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.recording import Recording, read_bag, write_bag
from dualfoot_ros.simulation import ClockConfig, WalkConfig, simulate
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals

SHIFT_NS = 41_250_000_000


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """Return a bag whose right foot's clock is 41.25 s ahead."""
    walk = simulate(WalkConfig(route="L", rate=60.0), seed=1)
    right = replace(walk.right, stamp_ns=walk.right.stamp_ns + SHIFT_NS)
    path = tmp_path_factory.mktemp("bags") / "walk"
    return write_bag(path, Recording(left=walk.left, right=right, notes={"from": "here"}))


@pytest.fixture(scope="module")
def live(tmp_path_factory):
    """Return a bag as recorded live: stamps of two device clocks, log times of arrival."""
    clocks = ClockConfig(offset=3000.0, drift=-250.0), ClockConfig(offset=-20.0, drift=700.0)
    walk = simulate(WalkConfig(route="L", standing=20.0), clock=clocks, seed=1)
    rng = np.random.default_rng(0)
    times = {}
    for foot in ("left", "right"):
        true = getattr(walk, f"{foot}_truth").stamp_ns
        times[foot] = arrivals(BleLinkConfig(interval=0.0371), true, rng)
    path = tmp_path_factory.mktemp("live") / "walk"
    write_with_log_times(path, {"left": walk.left, "right": walk.right}, times)
    return path, walk


def write_with_log_times(path, series, times):
    from rosbags.rosbag2 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    Imu, Header, Time, Quaternion, Vector3 = (
        store.types[f"{package}/msg/{name}"]
        for package, name in (
            ("sensor_msgs", "Imu"), ("std_msgs", "Header"), ("builtin_interfaces", "Time"),
            ("geometry_msgs", "Quaternion"), ("geometry_msgs", "Vector3"),
        )
    )  # fmt: skip
    none = np.zeros(9)
    with Writer(path, version=9) as writer:
        for foot, samples in series.items():
            topic = writer.add_connection(
                f"/{foot}/imu/data_raw", Imu.__msgtype__, typestore=store
            )
            for k, stamp in enumerate(samples.stamp_ns.tolist()):
                header = Header(Time(stamp // 10**9, stamp % 10**9), f"{foot}_imu")
                rate, force = (
                    Vector3(*samples.angular_rate[k]),
                    Vector3(*samples.specific_force[k]),
                )
                message = Imu(
                    header, Quaternion(0.0, 0.0, 0.0, 1.0), none, rate, none, force, none
                )
                data = store.serialize_cdr(message, Imu.__msgtype__)
                writer.write(topic, int(times[foot][k]), data)


def test_the_aligned_bag_has_both_feet_on_one_clock(bag, dualfoot_process, tmp_path):
    done = dualfoot_process("sync", bag, "-o", tmp_path / "out", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["method"] == "motion"
    assert found["offset_s"] == pytest.approx(-41.25, abs=0.02)
    assert found["confidence"] > 0.5
    before, after = read_bag(bag), read_bag(tmp_path / "out")
    np.testing.assert_array_equal(after.left.stamp_ns, before.left.stamp_ns)
    np.testing.assert_allclose(before.right.stamp_ns - after.right.stamp_ns, SHIFT_NS, atol=2e7)
    np.testing.assert_array_equal(after.right.angular_rate, before.right.angular_rate)
    assert after.notes["from"] == "here"
    assert after.notes["sync"].startswith("motion: right -41.2")


def test_without_an_output_nothing_is_written_and_all_is_said(bag, dualfoot, tmp_path):
    done = dualfoot("sync", bag, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    for word in ("method", "motion", "offset", "-41.2", "uncertainty", "skew", "confidence"):
        assert word in done.stdout
    assert list(tmp_path.iterdir()) == []


def test_a_bag_on_one_clock_is_left_as_it_is(bag, dualfoot, tmp_path):
    dualfoot("sync", bag, "-o", tmp_path / "once")
    done = dualfoot("sync", tmp_path / "once", "-o", tmp_path / "twice", "--method", "motion")
    assert "agree within the uncertainty" in done.stdout
    once, twice = read_bag(tmp_path / "once"), read_bag(tmp_path / "twice")
    np.testing.assert_array_equal(once.right.stamp_ns, twice.right.stamp_ns)


def test_log_times_of_a_live_recording_put_both_feet_on_the_host(live, dualfoot, tmp_path):
    path, walk = live
    done = dualfoot("sync", path, "-o", tmp_path / "out", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["method"] == "arrival"
    assert found["skew_ppm"] == pytest.approx(950.0, abs=40.0)
    after = read_bag(tmp_path / "out")
    for foot in ("left", "right"):
        true = getattr(walk, f"{foot}_truth").stamp_ns
        np.testing.assert_allclose(after.imu(foot).stamp_ns - true, 4e6, atol=2e6)
    assert found["notes"] == []


def test_log_times_that_follow_the_stamps_are_no_arrivals(bag, dualfoot):
    done = dualfoot("sync", bag, "--method", "arrival")
    assert done.returncode == 2
    assert "say nothing about the clocks" in done.stderr


def test_a_bag_of_one_foot_is_refused_by_name(bag, dualfoot, tmp_path):
    write_bag(tmp_path / "one", replace(read_bag(bag), right=None, right_truth=None))
    done = dualfoot("sync", tmp_path / "one")
    assert done.returncode == 2
    assert "no samples of the right foot" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_existing_output_is_not_replaced_unless_told_to(bag, dualfoot, tmp_path):
    out = tmp_path / "out"
    assert dualfoot("sync", bag, "-o", out).returncode == 0
    done = dualfoot("sync", bag, "-o", out)
    assert done.returncode == 2
    assert "exists already" in done.stderr
    assert dualfoot("sync", bag, "-o", out, "--overwrite").returncode == 0


def test_people_who_only_stand_are_refused_and_nothing_is_written(bag, dualfoot, tmp_path):
    whole = read_bag(bag)
    standing = replace(whole, left=whole.left[:800], right=whole.right[:800])
    write_bag(tmp_path / "standing", standing)
    done = dualfoot("sync", tmp_path / "standing", "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "walk" in done.stderr or "gait" in done.stderr
    assert not (tmp_path / "out").exists()


def test_help_has_examples_and_says_what_the_methods_are(dualfoot):
    done = dualfoot("sync", "--help")
    assert done.returncode == 0
    for word in ("examples:", "arrival", "shake", "motion", "--json"):
        assert word in done.stdout
