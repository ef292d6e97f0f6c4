"""The person without steps of the estimate and without the ripple of the gait, a fixed lag late.

The pose is the mean over a window of a second about a moment half a window ago: a correction
enters evenly over the window, however large it is, and what repeats itself from stride to stride
cancels.  The twist is the motion in the body frame over the window, without the turns and moves of
the whole track that an event announces.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

from ..rotation import about_z
from ..samples.row_window import RowWindow
from ..samples.series import FloatArray
from .person import RATE_SPAN_S, PersonEstimate

LONGEST_STEP_S = 0.5  # between two estimates; after a longer one the window fills anew


class SmoothedPerson(NamedTuple):
    """The person at the middle of the window.

    Attributes
    ----------
    position : (3,) m in the navigation frame; heading, rad
    velocity : (3,) m/s in the body frame (forward, left, up); yaw_rate, rad/s
    pose_covariance : (6, 6) of position (m) and rotation about fixed axes (rad)
    velocity_covariance : (3, 3) in the body frame, (m/s)^2; yaw_rate_variance, (rad/s)^2
    """

    stamp_ns: int
    position: FloatArray
    heading: float
    velocity: FloatArray
    yaw_rate: float
    pose_covariance: FloatArray
    velocity_covariance: FloatArray
    yaw_rate_variance: float


class Smoother:
    """Averages the person over a window of fixed length; the lag is half of it."""

    def __init__(self, window_s: float = 1.0, rate_hz: float = 50.0) -> None:
        """Average over ``window_s`` s; give at most ``rate_hz`` results a second."""
        self._window_ns = round(window_s * 1e9)
        self._period_ns = round(0.99e9 / rate_hz)
        self._kept: deque[PersonEstimate] = deque()
        # each: stamp since the start (s), heading (rad), position (3,) m; then since the one
        # before: forward, left, up (m), turn (rad)
        self._rows = RowWindow(8)
        self._last_ns: int | None = None
        self._stamps_ns = 0  # sum of the stamps that are kept

    @property
    def lag_s(self) -> float:
        """By how much a result is older than the newest estimate in it, s."""
        return 0.5e-9 * self._window_ns

    def clear(self) -> None:
        """Forget everything: the window fills anew."""
        self._kept.clear()
        self._rows.clear()
        self._stamps_ns = 0

    def add(self, person: PersonEstimate, moved: bool = False) -> SmoothedPerson | None:
        """Take an estimate; return the smoothed one if it is due, None while the window fills.

        ``moved`` says that the whole track was turned or moved at this epoch.
        """
        kept = self._kept
        if kept and not 0 < person.stamp_ns - kept[-1].stamp_ns < LONGEST_STEP_S * 1e9:
            self.clear()
            self._last_ns = None
        move = (0.0, 0.0, 0.0, 0.0) if moved or not kept else _move(kept[-1], person)
        self._rows.append((float(person.heading), *person.position.tolist(), *move))
        kept.append(person)
        self._stamps_ns += person.stamp_ns
        if person.stamp_ns - kept[0].stamp_ns < self._window_ns:
            return None
        while person.stamp_ns - kept[1].stamp_ns >= self._window_ns:
            self._stamps_ns -= kept.popleft().stamp_ns
            self._rows.drop_first()
        if self._last_ns is not None and person.stamp_ns - self._last_ns < self._period_ns:
            return None
        self._last_ns = person.stamp_ns
        return self._mean()

    def _mean(self) -> SmoothedPerson:
        """Return the mean over the window."""
        kept, rows = self._kept, self._rows.rows()
        middle_ns = self._stamps_ns // len(kept)
        seconds = (kept[-1].stamp_ns - kept[0].stamp_ns) * 1e-9
        velocity = rows[1:, 4:].sum(axis=0) / seconds
        middle = kept[len(kept) // 2]
        to_body = about_z(-middle.heading)
        return SmoothedPerson(
            middle_ns,
            rows[:, 1:4].mean(axis=0),
            float(rows[:, 0].mean()),
            velocity[:3],
            float(velocity[3]),
            middle.pose_covariance,
            # The errors of the epochs of a stance are alike: their mean is as good as one of them.
            to_body @ middle.velocity_covariance @ to_body.T,
            middle.yaw_rate_variance * (RATE_SPAN_S / seconds) ** 2,
        )


def _move(before: PersonEstimate, now: PersonEstimate) -> tuple[float, float, float, float]:
    """Return the way forward, to the left and up (m) and the turn (rad) between two estimates."""
    turn = now.heading - before.heading
    heading = before.heading + 0.5 * turn
    c, s = math.cos(heading), math.sin(heading)
    x, y, z = (now.position - before.position).tolist()
    return c * x + s * y, c * y - s * x, z, turn
