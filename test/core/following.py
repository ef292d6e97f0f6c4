"""A subscriber of a live tracker: it keeps the rows and turns them as the HEADING events say."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, field

import numpy as np

from dualfoot_ros.core import DualFootTracker, Event, EventKind, Trajectory
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.rows import turn_rows

from .harness import Pairs


@dataclass
class Followed:
    """What a live tracker has put out since it last started anew."""

    stamps: list[int] = field(default_factory=list)
    rows: list[np.ndarray] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    engines: set[str] = field(default_factory=set)
    refused: dict[str, int] = field(default_factory=dict)

    def turned(self) -> np.ndarray:
        """Return the rows (N, OUT), those before each HEADING event turned by it."""
        rows = np.array(self.rows).reshape(-1, lay.OUT)
        for event in self.events:
            if event.kind is EventKind.HEADING:
                turn_rows(rows[: bisect_left(self.stamps, event.stamp_ns)], event)
        return rows


def live(tracker: DualFootTracker, pairs: Pairs, found: Followed | None = None) -> Followed:
    """Feed the pairs one by one."""
    found = found or Followed()
    for pair in pairs:
        update = tracker.add(pair)
        found.engines.add(tracker.engine)
        if update.refused is not None:
            found.refused[update.refused] = found.refused.get(update.refused, 0) + 1
        for each in (*update.earlier, update):
            if any(event.kind is EventKind.RESET for event in each.announced):
                found.stamps, found.rows, found.events = [], [], []
            if each.row is not None:
                found.stamps.append(each.stamp_ns)
                found.rows.append(each.row)
            found.events.extend(each.announced)
    return found


def same_bits(followed: Followed, result: Trajectory) -> None:
    """Assert that a followed live run equals a trajectory to the bit, events and all."""
    rows = followed.turned()
    assert followed.stamps == result.left.stamp_ns.tolist()
    for foot, track in enumerate((result.left, result.right)):
        part = rows[:, foot * lay.O_FOOT : (foot + 1) * lay.O_FOOT]
        assert part[:, lay.O_POS : lay.O_POS + 3].tobytes() == track.position.tobytes()
        assert part[:, lay.O_VEL : lay.O_VEL + 3].tobytes() == track.velocity.tobytes()
        assert part[:, lay.O_QUAT : lay.O_QUAT + 4].tobytes() == track.quaternion.tobytes()
        diagonal = part[:, [lay.O_COV_POS + i for i in (0, 4, 8)]]
        found = np.diagonal(track.position_covariance, axis1=1, axis2=2)
        assert np.array_equal(diagonal, found)
    assert [key(e) for e in followed.events] == [key(e) for e in result.events]


def key(event: Event) -> tuple:
    """Return what makes an event what it is, in comparable form."""
    numbers = repr([event.innovation.tolist(), event.S.tolist(), event.nis])
    detail = sorted((name, str(value)) for name, value in event.detail.items())
    moments = event.stamp_ns, event.detected_ns
    return event.kind, *moments, event.foot, numbers, event.accepted, detail
