"""Air pressure in bags: what is written comes back, and what is wrong with it is said."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from recording.samples import moving, pressure, recording
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from dualfoot_ros.core import PressureSeries
from dualfoot_ros.inspection import Severity, findings_of, pressure_facts
from dualfoot_ros.recording import Recording, list_topics, read_bag, write_bag
from dualfoot_ros.recording.importers import ImportOptions, import_recording

STORE = get_typestore(Stores.ROS2_JAZZY)
FLUID = "sensor_msgs/msg/FluidPressure"
START = 10**18


def same(a, b):
    return np.array_equal(a.stamp_ns, b.stamp_ns) and a.pressure.tobytes() == b.pressure.tobytes()


def named(made):
    return {finding.kind: finding for finding in findings_of(made)}


def worn(series, where="left"):
    """Return a good recording with that pressure."""
    return Recording(moving(1), moving(2), pressure={where: series})


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_pressure_of_feet_and_body_comes_back_to_the_bit(tmp_path, storage):
    written = recording()
    write_bag(tmp_path / "walk", written, storage=storage)
    read = read_bag(tmp_path / "walk").pressure
    assert set(read) == {"left", "right", "both"}
    assert all(same(read[where], written.pressure[where]) for where in read)
    topics = list_topics(tmp_path / "walk")
    for topic in ("/left/pressure", "/right/pressure", "/pressure"):
        assert topics[topic].msgtype == FLUID


@settings(deadline=None, max_examples=20)
@given(
    st.lists(
        st.tuples(st.integers(0, 2**31 * 10**9 - 1), st.floats(width=64)), min_size=1, max_size=20
    )
)
def test_any_numbers_at_any_stamps_survive_a_bag(tmp_path_factory, rows):
    stamps, values = zip(*rows, strict=True)
    series = PressureSeries(np.array(stamps), np.array(values))
    path = write_bag(tmp_path_factory.mktemp("bag") / "b", Recording(pressure={"both": series}))
    read = read_bag(path).pressure["both"]
    assert read.stamp_ns.tolist() == list(stamps)
    assert np.array_equal(read.pressure, series.pressure, equal_nan=True)


def test_a_recording_without_pressure_has_none(tmp_path):
    write_bag(tmp_path / "walk", recording(pressure={}))
    assert read_bag(tmp_path / "walk").pressure == {}
    assert "/pressure" not in list_topics(tmp_path / "walk")


def test_what_is_written_decodes_as_a_ros_message_of_unknown_variance(tmp_path):
    write_bag(tmp_path / "walk", recording())
    found = {}
    with Reader(tmp_path / "walk") as reader:
        for connection, _, data in reader.messages():
            if connection.msgtype == FLUID and connection.topic not in found:
                found[connection.topic] = STORE.deserialize_cdr(data, FLUID)
    assert found["/right/pressure"].header.frame_id == "right_imu"
    assert found["/pressure"].header.frame_id == "base_link"
    assert found["/left/pressure"].fluid_pressure == recording().pressure["left"].pressure[0]
    assert found["/left/pressure"].variance == 0.0


def test_a_pressure_topic_of_another_type_is_left_alone(tmp_path):
    number = STORE.types["std_msgs/msg/Float64"]
    with Writer(tmp_path / "b", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/pressure", number.__msgtype__, typestore=STORE)
        data = STORE.serialize_cdr(number(data=1.0), number.__msgtype__)
        writer.write(connection, 0, data)
    assert read_bag(tmp_path / "b").pressure == {}


def test_facts_are_those_of_a_climb():
    stamps = START + np.arange(500) * 40_000_000
    climb = 101325.0 - 12.0 * np.linspace(0.0, 10.0, 500)  # 12 Pa a metre at sea level
    noise = np.random.default_rng(0).normal(0.0, 2.4, 500)
    facts = pressure_facts(PressureSeries(stamps, climb + noise))
    assert facts.rate_hz == pytest.approx(25.0)
    assert facts.highest_m == pytest.approx(
        9.5, abs=0.3
    )  # from the first second's mean to the last's
    assert abs(facts.lowest_m) < 0.3
    assert facts.noise_m == pytest.approx(0.2, rel=0.1)
    assert (facts.out_of_range, facts.out_of_order) == (0, 0)


def test_good_pressure_has_no_finding_and_each_fault_its_own():
    stamps = START + np.arange(300) * 40_000_000
    good = pressure(stamps)
    assert named(worn(good)) == {}
    hecto = named(worn(replace(good, pressure=good.pressure / 100.0)))["pressure_range"]
    assert "300 of 300 samples are no air pressure" in hecto.sentence
    assert "in hPa; publish Pa" in hecto.sentence
    values = good.pressure.copy()
    values[[3, 5]] = np.nan, -1.0
    broken = named(worn(replace(good, pressure=values), "both"))["pressure_range"]
    assert "pressure of the body: 2 of 300" in broken.sentence
    order = stamps.copy()
    order[10], order[20] = order[9], order[5]
    stamped = named(worn(replace(good, stamp_ns=order)))["pressure_stamps"]
    assert "2 duplicate or out-of-order stamps" in stamped.sentence
    other = named(worn(replace(good, stamp_ns=stamps - 10**15), "right"))["pressure_clock"]
    assert "shares no time with the left and the right foot" in other.sentence
    assert all(f.severity is Severity.WARNING for f in (hecto, broken, other))


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("value", [101325.0, np.nan, 0.0])
def test_a_few_samples_of_anything_have_facts(count, value):
    facts = pressure_facts(PressureSeries(START + np.arange(count), np.full(count, value)))
    assert facts.samples == count


def test_import_keeps_pressure_and_an_offset_moves_that_of_the_right_foot_only(tmp_path):
    written = recording()
    path = write_bag(tmp_path / "walk", written)
    moved = import_recording(ImportOptions(sources=(path,), right_offset_s=2.5)).pressure
    for where, series in written.pressure.items():
        shift = moved[where].stamp_ns - series.stamp_ns
        assert set(shift.tolist()) == {2_500_000_000 if where == "right" else 0}
        assert np.array_equal(moved[where].pressure, series.pressure)


def test_info_tells_of_the_barometers_in_words_and_in_json(tmp_path, dualfoot):
    bag = write_bag(tmp_path / "walk", recording(reference=None))
    done = dualfoot("info", bag, "--no-stances")
    assert done.returncode == 0
    assert "pressure on the left foot: 300 samples" in done.stdout
    assert "pressure on the body: 150 samples" in done.stdout
    assert re.search(r"12\.50 Hz, median (9499|9500)\d\.\d Pa", done.stdout)
    assert "--set aids.barometer=true" in done.stdout
    facts = json.loads(dualfoot("info", bag, "--no-stances", "--json").stdout)
    assert facts["pressure"]["right"]["rate_hz"] == pytest.approx(25.0)
