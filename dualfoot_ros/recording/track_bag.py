"""Estimated tracks as a rosbag2 folder: odometry at every epoch, and whole paths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..core import FloatArray, IntArray, RecordingError
from . import cdr
from .atomic import new_directory
from .open_bag import METADATA

ODOMETRY = "nav_msgs/msg/Odometry"
PATH = "nav_msgs/msg/Path"
DOUBLES = 85  # pose (3 + 4), covariance (36), twist (3 + 3), covariance (36)
UNKNOWN_VARIANCE = 1000.0


@dataclass(frozen=True)
class OdometrySeries:
    """What one odometry topic and one path topic of a bag hold.

    Attributes
    ----------
    topic : such as "/left/odometry"
    path_topic : such as "/left/path"
    frame, child_frame : of the pose
    stamp_ns : (N,)
    position, quaternion : (N, 3) m and (N, 4)
    position_covariance : (N, 3, 3) m^2
    yaw_variance : (N,) rad^2
    velocity, velocity_covariance : (N, 3) m/s and (N, 3, 3), in the child frame
    path_rows : (K,) rows of the poses of the path
    """

    topic: str
    path_topic: str
    frame: str
    child_frame: str
    stamp_ns: IntArray
    position: FloatArray
    quaternion: FloatArray
    position_covariance: FloatArray
    yaw_variance: FloatArray
    velocity: FloatArray
    velocity_covariance: FloatArray
    path_rows: IntArray


def write_track_bag(
    path: str | Path, tracks: Sequence[OdometrySeries], *, overwrite: bool = False
) -> Path:
    """Write tracks as an MCAP bag ``path`` and return the path.

    Each path is one message at the start, so that a viewer shows the whole way at once.

    Raises
    ------
    RecordingError
        When ``path`` exists (and ``overwrite`` is not set or it is no bag), or there is no track.
    OSError
        When the folder cannot be written.  Nothing is left half-written then.
    """
    path = Path(path)
    if not any(len(track.stamp_ns) for track in tracks):
        raise RecordingError("there is no track to write; give one with at least one epoch")
    with new_directory(path, overwrite=overwrite, marker=METADATA) as folder:
        _write(folder, tracks)
    return path


def _write(folder: Path, tracks: Sequence[OdometrySeries]) -> None:
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        odometry = [writer.add_connection(t.topic, ODOMETRY, typestore=store) for t in tracks]
        paths = [writer.add_connection(t.path_topic, PATH, typestore=store) for t in tracks]
        for track, connection in zip(tracks, paths, strict=True):
            message = store.serialize_cdr(_path(track, store), PATH)
            writer.write(connection, int(track.stamp_ns[0]), bytes(message))
        rows = [_messages(track) for track in tracks]
        for stamp, which, row in _in_order(tracks):
            writer.write(odometry[which], stamp, rows[which][row].tobytes())


def _in_order(tracks: Sequence[OdometrySeries]) -> list[tuple[int, int, int]]:
    """Return (stamp, track, row) of every odometry message in the order of time."""
    return sorted(
        (stamp, which, row)
        for which, track in enumerate(tracks)
        for row, stamp in enumerate(track.stamp_ns.tolist())
    )


def _messages(track: OdometrySeries) -> np.ndarray:
    values = np.zeros((len(track.stamp_ns), DOUBLES))
    values[:, :3], values[:, 3:7] = track.position, track.quaternion
    pose = values[:, 7:43].reshape(-1, 6, 6)
    pose[:, :3, :3] = track.position_covariance
    pose[:, 5, 5] = track.yaw_variance
    values[:, 43:46] = track.velocity
    twist = values[:, 49:].reshape(-1, 6, 6)
    twist[:, :3, :3] = track.velocity_covariance
    twist[:, [3, 4, 5], [3, 4, 5]] = UNKNOWN_VARIANCE  # of the angular rates
    return cdr.encode(track.stamp_ns, values, (track.frame, track.child_frame))


def _path(track: OdometrySeries, store: Any) -> Any:
    """Return the path message of a track."""
    kinds = store.types
    header = kinds["std_msgs/msg/Header"]
    poses = [
        kinds["geometry_msgs/msg/PoseStamped"](
            header(_time(kinds, int(track.stamp_ns[row])), track.frame),
            kinds["geometry_msgs/msg/Pose"](
                kinds["geometry_msgs/msg/Point"](*track.position[row].tolist()),
                kinds["geometry_msgs/msg/Quaternion"](*track.quaternion[row].tolist()),
            ),
        )
        for row in track.path_rows
    ]
    return kinds[PATH](header(_time(kinds, int(track.stamp_ns[0])), track.frame), poses)


def _time(kinds: Any, stamp_ns: int) -> Any:
    return kinds["builtin_interfaces/msg/Time"](*divmod(stamp_ns, 1_000_000_000))
