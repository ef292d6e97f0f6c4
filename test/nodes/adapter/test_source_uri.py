import pytest

from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.drivers import SourceError
from dualfoot_ros.nodes.adapter.source_uri import is_live, load, parse
from dualfoot_ros.recording import RecordingError, read_bag

VECTORS = ("acc_x_ms2", "acc_y_ms2", "acc_z_ms2", "gyr_x_dps", "gyr_y_dps", "gyr_z_dps")
STILL = ("0.0", "0.0", "9.81", "0.0", "0.0", "0.0")
SLIGHTLY_TURNED = ("0.0", "0.44", "9.80", "0.0", "0.0", "0.0")


@pytest.mark.parametrize(
    ("uri", "kind", "target"),
    [
        ("topic:///imu", "topic", "/imu"),
        ("topic:///imu_a/data", "topic", "/imu_a/data"),
        ("topic://imu/data", "topic", "imu/data"),
        ("file://walk.csv", "file", "walk.csv"),
        ("file:///data/walk.csv", "file", "/data/walk.csv"),
        ("file:///my%20data/walk", "file", "/my data/walk"),
        ("serial:///dev/tty9?format=mcu", "device", "serial:///dev/tty9?format=mcu"),
        ("udp://:8000?format=ximu3", "device", "udp://:8000?format=ximu3"),
        ("file://capture.bin?format=mcu", "device", "file://capture.bin?format=mcu"),
    ],
)
def test_a_source_is_a_kind_and_what_it_names(uri, kind, target):
    source = parse(uri)
    assert (source.kind, source.target) == (kind, target)


def test_a_captured_file_is_a_device_that_is_not_live():
    assert is_live(parse("udp://:8000?format=ximu3"))
    assert not is_live(parse("file://capture.bin?format=mcu"))
    assert not is_live(parse("topic:///imu"))


@pytest.mark.parametrize(
    ("uri", "said"),
    [
        ("serial:///dev/tty9", "add format= with one of mcu"),
        ("udp://:8000?format=magic", "format is 'magic'; allowed is one of mcu"),
        ("tcp://here:1?format=mcu&bout=9", "unknown option 'bout'"),
    ],
)
def test_a_device_that_is_misnamed_is_refused_with_what_is_allowed(uri, said):
    with pytest.raises(SourceError, match=said):
        parse(uri)


@pytest.mark.parametrize("uri", ["", "imu", "/imu", "ftp://a", "topic:///", "file://"])
def test_what_is_no_source_is_refused_with_what_is_allowed(uri):
    with pytest.raises(ConfigError, match="allowed is topic:///NAME or file://PATH"):
        parse(uri)


@pytest.mark.parametrize(
    ("uri", "said"),
    [
        ("topic:///left foot", "characters other than"),
        ("topic://9/imu", "must not start with a number"),
        ("topic:///imu/", "must not end with a forward slash"),
        ("topic:///{foot}/imu", "unknown substitution"),
        ("topic:///imu#1", "write %23"),
        ("file:///data/walk#1", "write %23"),
    ],
)
def test_a_name_that_no_topic_can_have_is_refused_in_one_line(uri, said):
    with pytest.raises(ConfigError, match=said) as refusal:
        parse(uri)
    assert f"'{uri}'" in str(refusal.value) and "\n" not in str(refusal.value)


def test_one_foot_of_a_bag_is_a_source(walk_bag):
    loaded = load(parse(f"file://{walk_bag}"), "right")
    expected = read_bag(walk_bag).right
    assert expected is not None
    assert (loaded.stamp_ns == expected.stamp_ns).all()


def test_captured_bytes_without_a_format_are_refused_with_the_formats(tmp_path):
    (tmp_path / "cap_mcu.bin").write_bytes(b"bytes")
    with pytest.raises(RecordingError, match=r"cap_mcu\.bin.*add \?format= with one of mcu, "):
        load(parse(f"file://{tmp_path}/cap_mcu.bin"), "left")


def test_a_missing_file_is_named():
    with pytest.raises(RecordingError, match=r"there is no file '/no/such\.csv'"):
        load(parse("file:///no/such.csv"), "left")


def test_a_csv_of_the_sensors_app_is_a_source(dual_feet):
    path = sorted(dual_feet.rglob("*.csv"))[0]
    series = load(parse(f"file://{path}"), "left")
    assert len(series) > 100


@pytest.mark.parametrize("foot", ["left", "right"])
def test_a_table_with_both_feet_gives_the_samples_of_the_one_asked_for(tmp_path, foot):
    names = [f"{side}_{name}" for side in ("left", "right") for name in VECTORS]
    rows = [f"{k / 100:.2f}," + ",".join(STILL + SLIGHTLY_TURNED) for k in range(200)]
    path = tmp_path / "both.csv"
    path.write_text("\n".join(["time," + ",".join(names), *rows]) + "\n")
    gravity = {"left": 9.81, "right": 9.80}
    assert load(parse(f"file://{path}"), foot).specific_force[0, 2] == gravity[foot]
