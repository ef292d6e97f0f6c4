"""Quality of service: one profile for each kind of topic."""

from __future__ import annotations

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy


def sensor(depth: int) -> QoSProfile:
    """Return the profile of raw samples: best effort, and deep enough to outlast a stall."""
    return _profile(depth, ReliabilityPolicy.BEST_EFFORT)


def result(depth: int = 200) -> QoSProfile:
    """Return the profile of estimates: reliable."""
    return _profile(depth, ReliabilityPolicy.RELIABLE)


def latched(depth: int = 1) -> QoSProfile:
    """Return the profile for late subscribers too: reliable, transient local."""
    return _profile(depth, ReliabilityPolicy.RELIABLE, DurabilityPolicy.TRANSIENT_LOCAL)


def clock() -> QoSProfile:
    """Return the profile of ``/clock``: only the newest counts."""
    return _profile(1, ReliabilityPolicy.BEST_EFFORT)


def _profile(
    depth: int,
    reliability: ReliabilityPolicy,
    durability: DurabilityPolicy = DurabilityPolicy.VOLATILE,
) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=reliability,
        durability=durability,
    )
