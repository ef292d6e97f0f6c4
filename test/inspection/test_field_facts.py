"""The magnetic field in a bag: what is told of it, and what is wrong with it is said."""

import json
from dataclasses import replace

import numpy as np
import pytest
from recording.samples import moving
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from dualfoot_ros.inspection import Severity, field_facts, findings_of, recorded_fields
from dualfoot_ros.recording import Recording, read_bag, write_bag

STORE = get_typestore(Stores.ROS2_JAZZY)
EARTH = np.array([17e-6, 0.0, -45e-6])
SIZE = float(np.linalg.norm(EARTH))


def felt(field, seed=1):
    """Return the samples of a good foot with ``field``, (3,) or (N, 3) in T."""
    series = moving(seed)
    return replace(series, magnetic_field=np.broadcast_to(field, (len(series), 3)))


def named(left):
    return {finding.kind: finding for finding in findings_of(Recording(left, moving(2)))}


def test_the_facts_count_what_was_measured_and_tell_its_size():
    field = np.tile(EARTH, (len(moving(1)), 1))
    field[::2] = np.nan
    field[1] *= 2.0
    facts = field_facts(felt(field))
    assert (facts.samples, facts.all_samples) == (len(field) // 2, len(field))
    assert facts.out_of_range == 0
    assert facts.low_t == facts.median_t == facts.high_t == pytest.approx(SIZE)


def test_a_foot_without_a_field_has_no_facts_and_no_objection():
    assert field_facts(moving(1)) is None
    assert list(recorded_fields(Recording(felt(EARTH), moving(2)))) == ["left"]
    assert not {"field_range", "field_stamps"} & set(named(felt(EARTH)))


@pytest.mark.parametrize(
    ("unit", "size_t"), [("uT", 1e-6), ("nT", 1e-9), ("G", 1e-4), ("mG", 1e-7)]
)
def test_a_field_in_another_unit_is_said_to_be(unit, size_t):
    finding = named(felt(EARTH / size_t))["field_range"]
    assert finding.severity is Severity.WARNING
    assert f"so they are in {unit}; publish T" in finding.sentence


def test_a_few_fields_that_cannot_be_are_counted_and_left_out():
    field = np.tile(EARTH, (len(moving(1)), 1))
    field[3] = [np.inf, 0.0, 0.0]
    field[7] = 0.0
    sentence = named(felt(field))["field_range"].sentence
    assert f"left foot: 2 of {len(field)} samples are no field of the earth in T" in sentence
    assert sentence.endswith("; they are left out")


def test_fields_with_stamps_of_their_own_are_not_lost_in_silence():
    finding = named(felt(np.full(3, np.nan)))["field_stamps"]
    assert finding.severity is Severity.WARNING
    assert "none has the stamp of a sample" in finding.sentence


def test_info_tells_of_the_field_in_words_and_in_json(tmp_path, dualfoot):
    bag = write_bag(tmp_path / "walk", Recording(felt(EARTH), moving(2)))
    words = dualfoot("info", bag, "--no-stances").stdout
    assert "magnetic field of the left foot: " in words and "median 48.1 uT" in words
    assert "of the right foot: " not in words
    facts = json.loads(dualfoot("info", bag, "--no-stances", "--json").stdout)
    assert facts["magnetic_field"]["left"]["median_t"] == pytest.approx(SIZE)


def bag_with(path, field_ns):
    """Write ten samples of the left foot, a ns apart, and fields of these stamps; return it."""
    types = STORE.types
    header, time = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
    vector, field = types["geometry_msgs/msg/Vector3"], types["sensor_msgs/msg/MagneticField"]
    imu, turn = types["sensor_msgs/msg/Imu"], types["geometry_msgs/msg/Quaternion"]
    up, nine = vector(x=0.0, y=0.0, z=9.8), np.zeros(9)

    def at(ns):
        return header(stamp=time(sec=5, nanosec=ns), frame_id="left_imu")

    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        for name, kind, messages in (
            ("data_raw", imu, [imu(at(k), turn(0.0, 0.0, 0.0, 1.0), nine, up, nine, up, nine)
                               for k in range(10)]),
            ("mag", field, [field(at(ns), vector(*EARTH.tolist()), nine) for ns in field_ns]),
        ):  # fmt: skip
            topic = f"/left/imu/{name}"
            connection = writer.add_connection(topic, kind.__msgtype__, typestore=STORE)
            for message in messages:
                data = STORE.serialize_cdr(message, kind.__msgtype__)
                writer.write(connection, message.header.stamp.nanosec, data)
    return read_bag(path).left


def test_a_field_belongs_to_the_sample_of_its_stamp_and_other_samples_have_none(tmp_path):
    found = bag_with(tmp_path / "walk", [2, 7, 70]).magnetic_field
    assert np.flatnonzero(~np.isnan(found).any(axis=1)).tolist() == [2, 7]
    assert found[7].tolist() == EARTH.tolist()


def test_a_topic_without_any_field_is_no_field(tmp_path):
    assert bag_with(tmp_path / "walk", []).magnetic_field is None
