"""Sources of the samples of ``imu_adapter``, named by URIs."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

from rclpy.exceptions import InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.validate_full_topic_name import validate_full_topic_name

from ...core import ConfigError, ImuSeries
from ...drivers import FORMATS, parse_uri
from ...recording import RecordingError, find_topics, read_bag
from ...settings import AdapterConfig
from ...timing import StampConfig
from ..ros.program import in_one_line

RECORDED = "file"
DEVICE = "device"
BAGS = (".mcap", ".db3", ".bag")
TABLES = (".csv", ".txt", ".tsv")
CAPTURED = tuple(name for name in FORMATS if name != "dot")  # which comes over BLE only
ALLOWED = (
    "topic:///NAME or file://PATH (the folder of a bag, a .mcap, .db3 or .bag, a .csv) "
    "or a device, as in serial:///dev/ttyUSB0?baud=921600&format=mcu, udp://:8000?format=ximu3, "
    "tcp://192.168.1.5:7000?format=ximu3, ble://D4:22:CD:00:12:34"
)
DEVICES = ("serial", "udp", "tcp", "ble")


class Source(NamedTuple):
    """A parsed source: its kind ("topic", "file" for recordings, "device") and its target."""

    kind: str
    target: str


def parse(uri: str) -> Source:
    """Return the parts of ``uri``; the target of a device is the whole URI.

    A file with options (``file://capture.bin?format=mcu``) is read as a device's bytes.

    Raises
    ------
    ConfigError
        For an unknown scheme or an impossible name of a topic; says what is allowed.
    SourceError
        For a device with an unknown format or option; says which.
    """
    try:
        parts = urlsplit(uri)
    except ValueError as error:
        raise ConfigError(f"parameter 'source' is '{uri}', no URI: {error}") from None
    if parts.scheme not in ("topic", RECORDED, *DEVICES):
        raise ConfigError(f"parameter 'source' is '{uri}'; allowed is {ALLOWED}")
    if parts.scheme in DEVICES or (parts.scheme == RECORDED and parts.query):
        parse_uri(uri)
        return Source(DEVICE, uri)
    target = unquote(parts.netloc + parts.path)
    if parts.scheme == "topic":
        target = target.replace("//", "/")  # topic://imu is a name in the node's namespace
    if not target.strip("/"):
        raise ConfigError(f"parameter 'source' is '{uri}' and names nothing; allowed is {ALLOWED}")
    if parts.fragment:
        raise ConfigError(f"parameter 'source' is '{uri}'; write %23 for a '#' in a name")
    if parts.scheme == "topic":
        _check_name(uri, target)
    return Source(parts.scheme, target)


def _check_name(uri: str, name: str) -> None:
    try:
        validate_full_topic_name(expand_topic_name(name, "imu_adapter", "/"))
    except (ValueError, InvalidTopicNameException) as error:
        reason = in_one_line(error)
        raise ConfigError(f"parameter 'source' is '{uri}' and names no topic: {reason}") from None


def is_live(source: Source) -> bool:
    """Return whether a source is a device whose samples come as they are taken."""
    return source.kind == DEVICE and urlsplit(source.target).scheme in DEVICES


def choose_stamping(source: Source, config: AdapterConfig, foot: str) -> StampConfig:
    """Return the stamping of the samples of ``foot`` that the parameters ask for."""
    policy = config.stamp
    if policy == "auto":
        policy = "device" if is_live(source) else "header"
    return StampConfig.from_mapping({foot: policy, f"{foot}_offset": config.stamp_offset})


def load(source: Source, foot: str) -> ImuSeries:
    """Return the recorded samples of ``foot`` of a ``file`` source.

    Raises
    ------
    RecordingError
        When the file cannot be read or has no samples of the foot.
    """
    path = Path(source.target).expanduser()
    if path.suffix.lower() in TABLES:
        return _from_table(path, foot)
    if path.is_file() and path.suffix not in BAGS:
        raise RecordingError(
            f"'{path}' is no bag ({', '.join(BAGS)} or a folder) and no table "
            f"({', '.join(TABLES)}); for bytes captured from a device add ?format= with one of "
            f"{', '.join(CAPTURED)}"
        )
    series = read_bag(path, topics=find_topics(path).topics).imu(foot)
    if series is None or not len(series):
        raise RecordingError(f"bag '{path}' has no samples on /{foot}/imu/data_raw")
    return series


def _from_table(path: Path, foot: str) -> ImuSeries:
    """Return the one sensor in a table, or that of ``foot`` where the table holds both."""
    from ...recording.importers import read_sensors

    if not path.exists():
        raise RecordingError(f"there is no file '{path}'")
    sensors = read_sensors(path, foot=foot)
    series = sensors.get(foot, sensors.get(""))
    if series is None or not len(series):
        raise RecordingError(f"'{path}' has no samples of the {foot} foot")
    return series
