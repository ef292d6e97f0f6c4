"""What the samples are, as a latched topic beside them: ``left/imu/increments``.

One ``std_msgs/String`` with a value of :class:`dualfoot_ros.core.Increments`.  A topic is what
nodes publish, ``ros2 bag record`` keeps and ``ros2 bag play`` publishes again.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..core import Increments, RecordingError
from .cdr import LITTLE_ENDIAN
from .topics import INCREMENTS_TYPE

if TYPE_CHECKING:
    from rosbags.interfaces import Qos

ALLOWED = ", ".join(kind.value for kind in Increments)


def encode_kind(kind: Increments) -> NDArray[np.uint8]:
    """Return the bytes (1, length) of a message that says ``kind``."""
    text = kind.value.encode() + b"\0"
    data = LITTLE_ENDIAN + struct.pack("<I", len(text)) + text
    return np.frombuffer(data, dtype=np.uint8)[None, :]


def decode_kind(messages: list[bytes], topic: str) -> Increments | None:
    """Return what the last message of ``topic`` says; None where there is none.

    Raises
    ------
    RecordingError
        When it is damaged, or says what is no kind; names the topic and what is allowed.
    """
    if not messages:
        return None
    from rosbags.typesys import Stores, get_typestore

    try:
        store = get_typestore(Stores.ROS2_JAZZY)
        text = store.deserialize_cdr(messages[-1], INCREMENTS_TYPE).data  # type: ignore[attr-defined]
    except Exception as error:  # the decoder raises whatever the broken bytes lead to
        raise RecordingError(
            f"the last message of topic '{topic}' is damaged ({type(error).__name__}); "
            "record again or leave the topic out"
        ) from error
    if text not in tuple(Increments):
        raise RecordingError(f"topic '{topic}' says '{text}'; allowed is one of {ALLOWED}")
    return Increments(text)


def latched_qos(depth: int = 1) -> Qos:
    """Return the QoS for a player to publish a topic with: reliable, transient local."""
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    never = QosTime(sec=2147483647, nsec=4294967295)
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=depth,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL,
        deadline=never,
        lifespan=never,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=never,
        avoid_ros_namespace_conventions=False,
    )
