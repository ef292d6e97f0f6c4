"""The kernel's output rows: what is in them, and their turn about the vertical."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..kernel import layout as lay
from ..samples.series import FloatArray, IntArray
from .events import FEET, Event, EventKind
from .payloads import YawTurn


def matrices(cells: FloatArray) -> FloatArray:
    """Return cells (..., 9) as matrices (..., 3, 3), without a copy."""
    return cells.reshape(*cells.shape[:-1], 3, 3)


def stance_nis(row: FloatArray, foot: int) -> float | None:
    """Return the NIS of the zero-velocity update in a row, if there is one."""
    if not row[foot * lay.O_FOOT + lay.O_STANCE]:
        return None
    return float(row[foot * lay.O_FOOT + lay.O_ZUPT + 12])


def zupt_event(row: FloatArray, foot: int, stamp_ns: int) -> Event | None:
    """Return the zero-velocity update in a row, if there is one."""
    o, nis = foot * lay.O_FOOT + lay.O_ZUPT, stance_nis(row, foot)
    if nis is None:
        return None
    return Event(
        EventKind.ZUPT,
        stamp_ns,
        FEET[foot],
        stamp_ns,
        row[o : o + 3],
        row[o + 3 : o + 12].reshape(3, 3),
        nis,
    )


def turn_rows(rows: FloatArray, event: Event) -> None:
    """Turn and move one foot's part of ``rows`` (N, OUT) in place, as a HEADING event says.

    Until both headings are known the feet are uncorrelated, so that the covariance of the
    separation changes as the foot's own does; when both feet turn together (``joint``), it turns
    as a whole, with the left one.
    """
    turn, foot = event.turn, FEET.index(event.foot)
    part = rows[:, foot * lay.O_FOOT : (foot + 1) * lay.O_FOOT]
    for start in (lay.O_VEL, lay.O_ZUPT):
        vectors = part[:, start : start + 3]
        vectors[:] = turn.vectors(vectors)
    position, quaternion = part[:, lay.O_POS : lay.O_POS + 3], part[:, lay.O_QUAT : lay.O_QUAT + 4]
    position[:], quaternion[:] = turn.positions(position), turn.quaternions(quaternion)
    relative = rows[:, lay.O_RELATIVE : lay.O_RELATIVE + 9]
    own = part[:, lay.O_COV_POS : lay.O_COV_POS + 9]
    if not turn.joint:
        relative -= own
    for start in (lay.O_COV_POS, lay.O_COV_VEL, lay.O_COV_ATT, lay.O_ZUPT + 3):
        _turn_covariances(part[:, start : start + 9], turn)
    if not turn.joint:
        relative += own
    elif foot == 0:
        _turn_covariances(relative, turn)


def _turn_covariances(cells: FloatArray, turn: YawTurn) -> None:
    matrices(cells)[:] = turn.covariances(matrices(cells))


def clean_stance(stamps: IntArray, events: Iterable[Event], foot: int) -> np.ndarray:
    """Return (N,) bool: the stance phases as they were confirmed, from the events."""
    stance = np.zeros(len(stamps), dtype=bool)
    open_at: int | None = None
    for event in events:
        if event.foot != FEET[foot]:
            continue
        if event.kind is EventKind.STANCE_START:
            open_at = event.stamp_ns
        elif event.kind is EventKind.STANCE_END and open_at is not None:
            first, last = np.searchsorted(stamps, [open_at, event.stamp_ns + 1])
            stance[first:last] = True
            open_at = None
    if open_at is not None:
        stance[np.searchsorted(stamps, open_at) :] = True
    return stance


def zupt_nis(rows: FloatArray) -> FloatArray:
    """Return the (N, 2) NIS of the zero-velocity updates of both feet, nan where there is none."""
    starts = [foot * lay.O_FOOT for foot in range(2)]
    return np.column_stack(
        [
            np.where(rows[:, o + lay.O_STANCE] > 0.0, rows[:, o + lay.O_ZUPT + 12], np.nan)
            for o in starts
        ]
    )
