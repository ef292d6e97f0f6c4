"""``straight_lines``: streets, corridors and tracks are straight, and mostly parallel.

At the end of each stance the direction of the stride that led to it is known.  Where the last
``straight_strides`` directions of a foot lie within a few degrees of each other and do not bend,
the person walks straight.  The first straight is a reference; a later one whose direction is that
of a reference, or opposite to it, within ``straight_gate``, is taken for parallel to it, and any
other becomes a reference itself.  Every fourth stride on a straight gives one row,

    direction - reference = -phi_z + noise,

for a direction turns with the heading of its foot: C_hat = (I - [phi x]) C.  One row turns the
heading by ``straight_clip`` at most, so a wrong match does little before it ends.

It assumes what the person does, not what physics says: a bend so slow that it looks straight is
straightened.  Hence off by default.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..constraints.method import Gait, Method, Request, StancePhase
from ..groups import AidsConfig
from ..joint_estimate import JointEstimate, Outcome
from ..kernel.layout import attitude_row
from ..results.events import EventKind
from ..rotation import turn_between
from ..samples.series import FloatArray

EVERY = 4  # strides of a foot from one row to the next; their mean direction is measured
LEAST_WAY_M = 0.4  # of a stride; a shorter one has no direction
SCATTER = math.radians(8.0)  # of a single direction about their mean
LONGEST_S = 1.2  # a middle of a stance farther back than half of it cannot be gone back to


class StraightLine(NamedTuple):
    """A row: direction of ``foot`` and its reference, and the turns of both feet, rad."""

    foot: int
    direction: float
    reference: float
    turned: tuple[float, float]

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        return {
            "aid": "straight_lines",
            "direction": self.direction,
            "reference": self.reference,
            "turned": list(self.turned),
        }


class FootDirections:
    """The directions of the last strides of one foot, rad, unwrapped."""

    def __init__(self, count: int) -> None:
        """Keep ``count`` of them."""
        self._directions: deque[float] = deque(maxlen=count)
        self._last: FloatArray | None = None
        self.since_row = 0

    def add(self, position: FloatArray) -> None:
        """Take the position (3,) m of a stance."""
        last, self._last = self._last, position
        if last is None:
            return
        way = position - last
        if math.hypot(way[0], way[1]) < LEAST_WAY_M:
            self._directions.clear()
            return
        direction = math.atan2(way[1], way[0])
        before = self._directions[-1] if self._directions else direction
        self._directions.append(before + math.remainder(direction - before, math.tau))
        self.since_row += 1

    def straight(self, bend: float) -> bool:
        """Return whether the strides are straight: their halves differ by less than ``bend``."""
        count = self._directions.maxlen
        if count is None or len(self._directions) < count:
            return False
        found = np.array(self._directions)
        halves = float(found[: count // 2].mean() - found[count - count // 2 :].mean())
        return abs(halves) < bend and bool((np.abs(found - found.mean()) < SCATTER).all())

    def mean(self, newest: int | None = None) -> float:
        """Return the mean direction of all strides kept, or of the ``newest``."""
        found = list(self._directions)
        return float(np.mean(found if newest is None else found[-newest:]))

    def turn(self, angle: float) -> None:
        """Take note that the track was turned by ``angle`` rad."""
        turned = [each + angle for each in self._directions]
        self._directions.clear()
        self._directions.extend(turned)

    def forget_place(self) -> None:
        """Take note that the track was moved."""
        self._last = None


class StraightLines(Method):
    """Observes the heading on straights, against the first of them and those parallel to it."""

    memory_s = 0.5 * LONGEST_S
    needs_heading = True

    def __init__(self, config: AidsConfig) -> None:
        """Use the parameters ``straight_*``."""
        self._config = config
        self._feet = [FootDirections(config.straight_strides) for _ in range(2)]
        self._references: list[float] = []

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return a row on every fourth stride of a straight."""
        foot = self._feet[stance.foot]
        moment = max(stance.moment(0.5), stance.last - round(self.memory_s / stance.period_s))
        if not gait.remembers(moment):
            foot.forget_place()
            return ()
        foot.add(gait.positions_after(moment)[stance.foot])
        if foot.since_row < EVERY or not foot.straight(self._config.straight_bend):
            return ()
        foot.since_row = 0
        direction = foot.mean(EVERY)
        reference = self._reference(foot.mean())
        innovation = math.remainder(direction - reference, math.pi)
        apply = partial(self._apply, foot=stance.foot, direction=direction, innovation=innovation)
        return (Request(gait.now, False, apply, EventKind.AID),)

    def _reference(self, direction: float) -> float:
        """Return the reference that ``direction`` rad is parallel to, or make it one."""
        off = [abs(math.remainder(direction - each, math.pi)) for each in self._references]
        if off and min(off) < self._config.straight_gate:
            return self._references[int(np.argmin(off))]
        self._references.append(direction)
        return direction

    def _apply(
        self, estimate: JointEstimate, foot: int, direction: float, innovation: float
    ) -> Outcome:
        """Turn the heading towards the reference; the same row whenever it is run again."""
        row = {attitude_row(foot, 2): -1.0}
        noise, clip = self._config.straight_std**2, self._config.straight_clip
        variance = float(estimate.variance([row])[0, 0])
        step = abs(innovation) * variance / (variance + noise)
        limited = innovation if step <= clip else innovation * clip / step
        before = [estimate.rotation(k) for k in range(2)]
        s, nis = estimate.update([row], [limited], [noise])
        left, right = (turn_between(before[k], estimate.rotation(k)) for k in range(2))
        line = StraightLine(foot, direction, direction - innovation, (left, right))
        return Outcome(np.array([innovation]), s, nis, True, line)

    def note(self, outcome: Outcome) -> None:
        """Turn the directions so far with the headings."""
        if isinstance(outcome.payload, StraightLine):
            for foot, turned in zip(self._feet, outcome.payload.turned, strict=True):
                foot.turn(turned)

    def moved(self, up_m: float, turned: float) -> None:
        """Turn references and directions with the track."""
        self._references = [each + turned for each in self._references]
        for foot in self._feet:
            foot.turn(turned)
            foot.forget_place()
