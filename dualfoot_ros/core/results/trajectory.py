"""Trajectories: the estimates of a whole walk, and its stance phases."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..samples.by_block import picked
from ..samples.series import BoolArray, FloatArray, IntArray
from .covariances import Covariances
from .events import Event, EventKind
from .payloads import YawTurn

COVARIANCES = ("position_covariance", "velocity_covariance", "attitude_covariance")


@dataclass(frozen=True)
class FootTrajectory:
    """Estimates of one foot, one row an epoch, in the navigation frame (z up).

    Attributes
    ----------
    stamp_ns : (N,) int64
    position : (N, 3) m
    velocity : (N, 3) m/s, navigation frame
    quaternion : (N, 4) body to navigation, Hamilton, x y z w
    stance : (N,) bool
    position_covariance, velocity_covariance, attitude_covariance : (N, 3, 3), navigation frame;
        arrays to whoever indexes them or calculates with them
    present : (N,) bool, where the foot had samples (default: everywhere)
    """

    stamp_ns: IntArray
    position: FloatArray
    velocity: FloatArray
    quaternion: FloatArray
    stance: np.ndarray
    position_covariance: Covariances
    velocity_covariance: Covariances
    attitude_covariance: Covariances
    present: BoolArray = field(default_factory=lambda: np.empty(0, dtype=bool))

    def __post_init__(self) -> None:
        """Take the foot for present everywhere when nothing is said of it, and arrays as given."""
        if len(self.present) != len(self.stamp_ns):
            object.__setattr__(self, "present", np.ones(len(self.stamp_ns), dtype=bool))
        for name in COVARIANCES:
            object.__setattr__(self, name, Covariances.of(getattr(self, name)))

    def __len__(self) -> int:
        """Return the number of epochs."""
        return len(self.stamp_ns)

    @property
    def distance_m(self) -> float:
        """Walked distance: the horizontal way from stance to stance."""
        anchors = picked(self.position, stance_middles(self.stance))[:, :2]
        return float(np.linalg.norm(np.diff(anchors, axis=0), axis=1).sum())

    def cut(self, keep: BoolArray | slice) -> FootTrajectory:
        """Return the epochs that a mask (N,) or a slice of neighbours keeps."""
        parts: dict[str, Any] = vars(self)
        kept = {
            name: part.cut(keep) if name in COVARIANCES else part[keep]
            for name, part in parts.items()
        }
        return FootTrajectory(**kept)

    def turned(self, by: YawTurn) -> FootTrajectory:
        """Return the whole track turned and shifted, covariances included."""
        return replace(
            self,
            position=by.positions(self.position),
            velocity=by.vectors(self.velocity),
            quaternion=by.quaternions(self.quaternion),
            position_covariance=Covariances.of(by.covariances(self.position_covariance[:])),
            velocity_covariance=Covariances.of(by.covariances(self.velocity_covariance[:])),
            attitude_covariance=Covariances.of(by.covariances(self.attitude_covariance[:])),
        )


@dataclass(frozen=True)
class Trajectory:
    """Both feet over a recording, what was applied when, and what was refused.

    ``relative_covariance`` (N, 3, 3) is the covariance of left minus right position.
    ``start_ns`` is the epoch at which the alignment was done and the output starts.
    ``zupt_nis`` (N, 2) is the NIS of each foot's zero-velocity update, nan where there was none.
    ``heading_std`` rad is the standard deviation of the heading at the end, the mean of the feet
    that are there, also where covariances are not kept; nan where it is not known.
    """

    left: FootTrajectory
    right: FootTrajectory
    relative_covariance: Covariances
    events: tuple[Event, ...]
    counters: Mapping[str, int]
    start_ns: int
    method: str
    zupt_nis: FloatArray = field(default_factory=lambda: np.empty((0, 2)))
    heading_std: float = math.nan

    def __post_init__(self) -> None:
        """Take an array of covariances as given."""
        relative = Covariances.of(self.relative_covariance)
        object.__setattr__(self, "relative_covariance", relative)

    def of_kind(self, kind: EventKind, foot: str | None = None) -> list[Event]:
        """Return the events of one kind, of one foot if given."""
        return [e for e in self.events if e.kind is kind and foot in (None, e.foot)]


def stance_bounds(stance: np.ndarray) -> np.ndarray:
    """Return (M, 2) first and one-past-last index of every run of True in ``stance`` (N,)."""
    padded = np.concatenate(([False], np.asarray(stance, dtype=bool), [False]))
    return np.flatnonzero(padded[1:] != padded[:-1]).reshape(-1, 2)


def stance_middles(stance: np.ndarray) -> IntArray:
    """Return the (M,) middle index of every stance."""
    bounds = stance_bounds(stance)
    middles: IntArray = (bounds[:, 0] + bounds[:, 1] - 1) // 2
    return middles
