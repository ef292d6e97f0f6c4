"""`dualfoot probe` as a user runs it: a capture, two feet, what cannot be read, a scan."""

import json
import struct

import pytest
import yaml
from drivers.frames import item, stream

from dualfoot_ros.settings import node_parameter_names


@pytest.fixture
def capture(tmp_path):
    """Return what writes a capture and gives its URI."""

    def write(name, data):
        path = tmp_path / f"{name}.bin"
        path.write_bytes(data)
        return f"file://{path}"

    return write


def test_a_capture_is_described_and_its_parameters_are_ready_to_paste(capture, dualfoot):
    uri = capture("walk", stream("mcu", 400))
    done = dualfoot("probe", uri)
    assert done.returncode == 0
    assert "400 samples: 200.0 Hz" in done.stderr
    section = yaml.safe_load(done.stdout)["/**/left/imu_adapter"]["ros__parameters"]
    assert section["source"] == f"{uri}?format=mcu"
    assert section["checks"] == {"rate": 200.0}


@pytest.mark.parametrize("ticks", [1, 100])
def test_a_table_is_described_as_the_adapter_reads_it(tmp_path, ticks, dualfoot):
    names = "PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z"
    rows = [f"{k},{1000 + k * 10_000 // ticks},0,0,{9.8 + k % 3 / 100},1,{k % 2},0"
            for k in range(300)]  # fmt: skip
    (tmp_path / "left.csv").write_text("\n".join([names, *rows]) + "\n")
    done = dualfoot("probe", "file://left.csv", cwd=tmp_path)
    assert "300 samples: 100.0 Hz" in done.stderr
    section = yaml.safe_load(done.stdout)["/**/left/imu_adapter"]["ros__parameters"]
    assert section == {"source": "file://left.csv", "checks": {"rate": 100.0}}
    (tmp_path / "left.csv").write_text("a,b\n1,2\n3,4\n")
    done = dualfoot("probe", "file://left.csv", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert "no specific force and no angular rate" in done.stderr


def test_two_sources_are_the_left_and_the_right_foot(capture, dualfoot):
    left, right = capture("l", stream("xbus", 200)), capture("r", stream("vectornav_ascii", 200))
    done = dualfoot("probe", left, right)
    found = yaml.safe_load(done.stdout)
    assert list(found) == ["/**/left/imu_adapter", "/**/right/imu_adapter"]
    for section in found.values():
        names = set(section["ros__parameters"])
        assert names <= {name.partition(".")[0] for name in node_parameter_names()}
    assert "rate unknown" in done.stderr  # the lines hold no time


def test_one_source_can_be_the_right_foot_and_json_is_one_object(capture, dualfoot):
    uri = capture("walk", stream("ximu3", 300))
    assert "/**/right/imu_adapter" in dualfoot("probe", uri, "--foot", "right").stdout
    done = dualfoot("probe", uri, "--json")
    report = json.loads(done.stdout)["left"]
    assert report["formats"][0]["format"] == "ximu3"
    assert report["facts"]["rate_hz"] == pytest.approx(200.0)


def test_bytes_of_no_known_format_end_with_2_and_no_parameters(capture, dualfoot):
    done = dualfoot("probe", capture("noise", bytes(range(128, 250)) * 20))
    assert done.returncode == 2
    assert "no known format is in them" in done.stderr
    assert done.stdout == ""
    done = dualfoot("probe", capture("empty", b""))
    assert done.returncode == 2
    assert "nothing came" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "give one URI, two for the left and the right foot, or --scan"),
        (["udp://:1", "--scan"], "give one URI"),
        (["udp://:1", "udp://:2", "udp://:3"], "give one URI"),
        (["udp://:1", "--seconds", "0"], "--seconds is 0; allowed is 0.1 to 600"),
        (["file:///no/such.bin"], "does not exist"),
        (["nonsense"], "source 'nonsense' starts with no known scheme; allowed is"),
        (["/dev/no_such"], "(did you mean 'serial:///dev/no_such'?)"),
        (["serial:///dev/no_such?baud=9600"], ": /dev/no_such: No such file or directory\n"),
    ],
)
def test_what_cannot_be_probed_is_one_sentence(arguments, sentence, dualfoot):
    done = dualfoot("probe", *arguments)
    assert done.returncode == 2
    assert sentence in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_a_scan_lists_each_kind_and_says_what_is_missing(monkeypatch, dualfoot):
    from dualfoot_ros import drivers

    def missing(seconds):
        raise drivers.SourceError("Bluetooth needs bleak")

    port = drivers.Found(("serial:///dev/ttyUSB0",), "CP2102")
    monkeypatch.setattr(drivers, "serial_ports", lambda: [port])
    monkeypatch.setattr(drivers, "bluetooth_devices", missing)
    monkeypatch.setattr(drivers, "announced_devices", lambda seconds: [])
    done = dualfoot("probe", "--scan")
    assert done.returncode == 0
    assert "dualfoot probe 'serial:///dev/ttyUSB0'" in done.stdout
    assert "x-IMU3 in the network: none" in done.stdout
    assert "Bluetooth needs bleak" in done.stderr


def test_devices_that_share_a_bus_are_listed_with_how_to_choose(capture, dualfoot):
    data = b""
    for k in range(60):
        for device in (1, 2):
            motion = item(0x1060, struct.pack(">I", 50 * k)) + item(0x8020, bytes(12))
            content = motion + item(0x4020, struct.pack(">3f", 0.01 * (k % 3), 0.0, 9.8))
            body = bytes([device, 0x36, len(content)]) + content
            data += b"\xfa" + body + bytes([-sum(body) % 256])
    done = dualfoot("probe", capture("bus", data))
    assert "several devices are on the bus: 1, 2; choose one with bus_id=" in done.stderr
    assert "60 samples" in done.stderr
