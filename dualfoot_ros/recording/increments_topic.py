"""What the samples are, as a latched topic beside them: ``left/imu/increments``.

One ``std_msgs/String`` with a value of :class:`dualfoot_ros.core.Increments`.  A topic is what
nodes publish, ``ros2 bag record`` keeps and ``ros2 bag play`` publishes again.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from ..core import Increments, RecordingError
from .cdr import LITTLE_ENDIAN, decode_text

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
    try:
        text = decode_text(messages[-1])
    except ValueError as error:
        raise RecordingError(
            f"the last message of topic '{topic}' is damaged ({error}); "
            "record again or leave the topic out"
        ) from error
    if text not in tuple(Increments):
        raise RecordingError(f"topic '{topic}' says '{text}'; allowed is one of {ALLOWED}")
    return Increments(text)
