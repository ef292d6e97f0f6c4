"""Messages of one topic as arrays: fast where all have one layout, one by one where not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, IntArray, RecordingError
from . import cdr
from .topics import FIELD_TYPE, IMU_TYPE, PRESSURE_TYPE, TRUTH_TYPE, VECTOR_TYPE

IMU_DOUBLES = 37  # orientation, its covariance, rate, covariance, specific force, covariance
FIELD_DOUBLES = 12  # field, its covariance
VECTOR_DOUBLES = 3
PRESSURE_DOUBLES = 2  # pressure, its variance
TRUTH_DOUBLES = 85  # pose (3 + 4), covariance (36), twist (3 + 3), covariance (36)
RATE = slice(13, 16)
FORCE = slice(25, 28)


@dataclass(frozen=True)
class Table:
    """All messages of one topic: stamps (N,) ns, values (N, doubles), strings of the first.

    ``log_ns`` (N,) are the times at which the messages were logged.
    """

    stamp_ns: IntArray
    values: FloatArray
    texts: list[str]
    log_ns: IntArray


def table(messages: list[bytes], log_ns: list[int], msgtype: str, topic: str) -> Table:
    """Decode all ``messages`` of ``topic``, of type ``msgtype`` and logged at ``log_ns``.

    Raises
    ------
    RecordingError
        When a message cannot be decoded; names the topic and which message it is.
    """
    doubles, texts = _LAYOUT[msgtype]
    logged = np.array(log_ns, dtype=np.int64)
    if not messages:
        empty = np.empty(0, dtype=np.int64)
        return Table(empty, np.empty((0, doubles)), [""] * texts, logged)
    fast = cdr.decode(messages, doubles, texts)
    return Table(*(fast or _one_by_one(messages, msgtype, topic)), logged)


def _one_by_one(
    messages: list[bytes], msgtype: str, topic: str
) -> tuple[IntArray, FloatArray, list[str]]:
    doubles, texts = _LAYOUT[msgtype]
    stamps = np.empty(len(messages), dtype=np.int64)
    values = np.empty((len(messages), doubles))
    strings: list[str] = []
    for i, data in enumerate(messages):
        try:
            stamps[i], values[i], found = cdr.decode_one(data, doubles, texts)
        except ValueError as error:
            raise RecordingError(
                f"message {i} of topic '{topic}' is damaged ({error}); record again or cut the "
                "bag before it"
            ) from error
        strings = strings or found
    return stamps, values, strings


_LAYOUT = {
    IMU_TYPE: (IMU_DOUBLES, 1),
    VECTOR_TYPE: (VECTOR_DOUBLES, 1),
    FIELD_TYPE: (FIELD_DOUBLES, 1),
    PRESSURE_TYPE: (PRESSURE_DOUBLES, 1),
    TRUTH_TYPE: (TRUTH_DOUBLES, 2),
}
