"""The estimate as an MCAP bag with the topics of the live nodes, for RViz and Foxglove."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core import FloatArray, FootTrajectory, Trajectory, stance_middles
from ...recording import OdometrySeries, write_track_bag
from ..tracked_person import PersonTrack
from .person_files import heading_quaternions

BAG_NAME = "estimate_bag"
FRAME = "odom"
PATH_POINTS = 2000


def write_estimate_bag(directory: Path, trajectory: Trajectory, person: PersonTrack) -> Path:
    """Write ``estimate_bag`` with odometry and paths of both feet and of the person.

    Topics, types and frames are those of the node ``fusion``, and ``/path`` of the person.
    """
    feet = {"left": trajectory.left, "right": trajectory.right}
    tracks = [*(_foot(name, track) for name, track in feet.items()), _person(trajectory, person)]
    return write_track_bag(directory / BAG_NAME, tracks)


def _foot(name: str, track: FootTrajectory) -> OdometrySeries:
    from scipy.spatial.transform import Rotation

    turned = Rotation.from_quat(track.quaternion)
    return OdometrySeries(
        topic=f"/{name}/odometry",
        path_topic=f"/{name}/path",
        frame=FRAME,
        child_frame=f"{name}_foot",
        stamp_ns=track.stamp_ns,
        position=track.position,
        quaternion=track.quaternion,
        position_covariance=track.position_covariance[:],
        yaw_variance=track.attitude_covariance[:, 2, 2],
        velocity=turned.apply(track.velocity, inverse=True),
        velocity_covariance=_in_body(turned.as_matrix(), track.velocity_covariance[:]),
        path_rows=np.unique(np.append(stance_middles(track.stance), len(track) - 1)),
    )


def _person(trajectory: Trajectory, person: PersonTrack) -> OdometrySeries:
    from scipy.spatial.transform import Rotation

    left, right = trajectory.left, trajectory.right
    count = len(person.stamp_ns)
    quaternion = heading_quaternions(person.heading)
    turned = Rotation.from_quat(quaternion)
    # The mean of both feet: without their correlation an upper bound of the mean's covariance.
    velocity_covariance = (left.velocity_covariance + right.velocity_covariance) / 2
    return OdometrySeries(
        topic="/odometry",
        path_topic="/path",
        frame=FRAME,
        child_frame="base_footprint",
        stamp_ns=person.stamp_ns,
        position=person.position,
        quaternion=quaternion,
        position_covariance=person.covariance[:],
        yaw_variance=(left.attitude_covariance + right.attitude_covariance)[:, 2, 2] / 2,
        velocity=turned.apply((left.velocity + right.velocity) / 2, inverse=True),
        velocity_covariance=_in_body(turned.as_matrix(), velocity_covariance),
        path_rows=np.unique(np.linspace(0, count - 1, min(count, PATH_POINTS)).astype(np.int64)),
    )


def _in_body(to_nav: FloatArray, covariance: FloatArray) -> FloatArray:
    """Return covariances (N, 3, 3) in the frame that ``to_nav`` (N, 3, 3) turns to navigation."""
    turned: FloatArray = np.swapaxes(to_nav, 1, 2) @ covariance @ to_nav
    return turned
