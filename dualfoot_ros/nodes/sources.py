"""Where the samples of ``imu_adapter`` come from: a source is named by a URI."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple
from urllib.parse import parse_qsl, unquote, urlsplit

from ..core.errors import ConfigError
from ..core.series import ImuSeries
from ..recording import RecordingError, read_bag

SCHEMES = ("topic", "file")
ALLOWED = "topic:///NAME or file://PATH (the folder of a bag, a .mcap, a .db3, an Xsens DOT .csv)"


class Source(NamedTuple):
    """A parsed source: scheme, what it names, and further options."""

    scheme: str
    target: str
    options: dict[str, str]


def parse(uri: str) -> Source:
    """Return the parts of ``uri``; raise ConfigError saying what is allowed."""
    parts = urlsplit(uri)
    if parts.scheme not in SCHEMES:
        raise ConfigError(f"parameter 'source' is '{uri}'; allowed is {ALLOWED}")
    target = unquote(parts.netloc + parts.path)
    if parts.scheme == "topic":
        target = target.replace("//", "/")  # topic://imu is a name in the node's namespace
    if not target.strip("/"):
        raise ConfigError(f"parameter 'source' is '{uri}' and names nothing; allowed is {ALLOWED}")
    return Source(parts.scheme, target, dict(parse_qsl(parts.query)))


def load(source: Source, foot: str) -> ImuSeries:
    """Return the recorded samples of ``foot`` of a ``file`` source.

    Raises
    ------
    RecordingError
        When the file cannot be read or has no samples of the foot.
    """
    path = Path(source.target).expanduser()
    if path.suffix.lower() == ".csv":
        return _from_csv(path)
    series = read_bag(path).imu(foot)
    if series is None or not len(series):
        raise RecordingError(f"bag '{path}' has no samples on /{foot}/imu/data_raw")
    return series


def _from_csv(path: Path) -> ImuSeries:
    """Return the one sensor in a csv; the importer wants a pair, so it gets the file twice."""
    from ..recording.importers import ImportOptions, import_recording

    series = import_recording(ImportOptions(left=path, right=path)).left
    if series is None or not len(series):
        raise RecordingError(f"'{path}' has no samples")
    return series
