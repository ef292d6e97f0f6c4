"""The kernel's output rows: what is in them, and their turn about the vertical."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
    """Turn and move one foot's part of ``rows`` (N, OUT) in place, as a HEADING event says."""
    turn, foot = event.turn, FEET.index(event.foot)
    part = rows[:, foot * lay.O_FOOT : (foot + 1) * lay.O_FOOT]
    turn_nominal(part, turn)
    innovation = part[:, lay.O_ZUPT : lay.O_ZUPT + 3]
    innovation[:] = turn.vectors(innovation)
    own = [part[:, start : start + 9] for start in (lay.O_COV_POS, lay.O_COV_VEL, lay.O_COV_ATT)]
    turn_covariances(own, rows[:, lay.O_RELATIVE : lay.O_RELATIVE + 9], turn, foot)
    _turn(part[:, lay.O_ZUPT + 3 : lay.O_ZUPT + 12], turn)


def turn_nominal(part: FloatArray, turn: YawTurn) -> None:
    """Turn and move the nominal states of a foot, which each row of ``part`` begins with."""
    velocity = part[:, lay.O_VEL : lay.O_VEL + 3]
    velocity[:] = turn.vectors(velocity)
    position, quaternion = part[:, lay.O_POS : lay.O_POS + 3], part[:, lay.O_QUAT : lay.O_QUAT + 4]
    position[:], quaternion[:] = turn.positions(position), turn.quaternions(quaternion)


def turn_covariances(
    own: Sequence[FloatArray], relative: FloatArray, turn: YawTurn, foot: int
) -> None:
    """Turn a foot's covariances (N, 9) of position, velocity and attitude, and the ``relative``.

    Until both headings are known the feet are uncorrelated, so that the covariance of the
    separation changes as the foot's own does; when both feet turn together (``joint``), it turns
    as a whole, with the left one.
    """
    if not turn.joint:
        relative -= own[0]
    for cells in own:
        _turn(cells, turn)
    if not turn.joint:
        relative += own[0]
    elif foot == 0:
        _turn(relative, turn)


def _turn(cells: FloatArray, turn: YawTurn) -> None:
    matrices(cells)[:] = turn.covariances(matrices(cells))


def clean_stance(stamps: IntArray, events: Iterable[Event], foot: int) -> np.ndarray:
    """Return (N,) bool: the stance phases as they were confirmed, from the events."""
    bounds: list[int] = []  # the first and the last stamp of each, one after the other
    open_at: int | None = None
    for event in events:
        if event.foot != FEET[foot]:
            continue
        if event.kind is EventKind.STANCE_START:
            open_at = event.stamp_ns
        elif event.kind is EventKind.STANCE_END and open_at is not None:
            bounds += open_at, event.stamp_ns + 1
            open_at = None
    stance = np.zeros(len(stamps), dtype=bool)
    for first, last in np.searchsorted(stamps, bounds).reshape(-1, 2).tolist():
        stance[first:last] = True
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
