"""Events of the tracker as messages: readable for a person, exact for a program."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from ...core import Details, Event, EventKind, YawTurn
from ..ros.messages import set_time
from ..ros.status import OK, WARN


def to_message(events: tuple[Event, ...], stamp_ns: int) -> DiagnosticArray:
    """Return the events of one epoch; numbers are written so that they are read back exactly."""
    message = DiagnosticArray()
    set_time(message.header.stamp, stamp_ns)
    message.status = [_to_status(event) for event in events]
    return message


def from_message(message: DiagnosticArray) -> list[Event]:
    """Return the events of a message made by :func:`to_message`."""
    return [_to_event(status) for status in message.status]


def summarise(event: Event) -> str:
    """Return in a few words what happened."""
    detail = ", ".join(f"{key} {_format(value)}" for key, value in event.detail.items())
    refused = "" if event.accepted else " (refused)"
    return f"{event.kind.value} of {event.foot}{refused}" + (f": {detail}" if detail else "")


def _to_status(event: Event) -> DiagnosticStatus:
    values = {
        "stamp_ns": event.stamp_ns,
        "detected_ns": event.detected_ns,
        "innovation": event.innovation.tolist(),
        "S": event.S.tolist(),
        "nis": event.nis,
        "accepted": event.accepted,
        "detail": _to_plain(event.detail),
    }
    return DiagnosticStatus(
        level=OK if event.accepted else WARN,
        name=event.kind.value,
        hardware_id=event.foot,
        message=summarise(event),
        values=[KeyValue(key=key, value=json.dumps(value)) for key, value in values.items()],
    )


def _to_event(status: DiagnosticStatus) -> Event:
    values = {pair.key: json.loads(pair.value) for pair in status.values}
    kind, detail = EventKind(status.name), values["detail"]
    turn = kind is EventKind.HEADING
    return Event(
        kind,
        values["stamp_ns"],
        status.hardware_id,
        values["detected_ns"],
        np.array(values["innovation"], dtype=np.float64),
        np.array(values["S"], dtype=np.float64).reshape(-1, max(1, len(values["innovation"]))),
        values["nis"],
        values["accepted"],
        YawTurn.from_dict(detail) if turn else Details(detail),
    )


def _to_plain(value: Any) -> Any:
    """Return ``value`` with numpy's types turned into Python's."""
    if isinstance(value, Mapping):
        return {str(key): _to_plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_to_plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return value


def _format(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "(" + ", ".join(_format(float(v)) for v in value) + ")"
    return str(value)
