"""``magnetic_heading``: the direction of the earth's field, against that on the first stances.

The only thing here that sees the heading error both feet share.  Each stance gives its heading
once, at its middle, where the foot is slowest: the mean of the field measured around that moment,
turned to navigation axes by the filter's own attitude, is compared with the reference of the same
foot, the mean over its first stances of a known heading.  A foot is compared with itself, so what
magnets and iron on it add drops out as far as it points the same way; the rest repeats from stance
to stance, which is why ``magnetic_std`` is far above the noise.  Once the walk has turned, the
iron is known (:mod:`.hard_iron`), is taken off, and ``magnetic_iron_std`` takes its place.

With m = (x, y, z) the field in navigation axes and h^2 = x^2 + y^2, the measured heading of the
field is psi = atan2(y, x).  The attitude error phi of C_hat = (I - [phi x]) C makes m_hat = m +
m x phi, and d psi = (x dy - y dx) / h^2 gives the row

    d psi / d phi = (x z / h^2, y z / h^2, -1).

Where the field dips steeply (z / h is 3.3 at 73 degrees) a tilt turns it much more than a yaw: the
first two terms keep the filter from taking for heading what may be tilt.

Indoors the field is that of the building.  A stance counts only where size and dip are those of
the reference, and the reference counts only when all of its stances agree; until they do it is
sought further on.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ..constraints.method import Gait, Method, Request, StancePhase
from ..groups import AidsConfig
from ..joint_estimate import JointEstimate, Outcome, nothing_done
from ..kernel.layout import attitude_row
from ..refusals import Refusal
from ..results.events import FEET, EventKind
from ..results.payloads import FieldDirection, Reason
from ..rotation import about_z, turn_between
from ..samples.series import FloatArray
from .field import FieldLog, NavigationField, mean_field
from .hard_iron import HardIron

AROUND_NS = 100_000_000  # of the middle of a stance the field is averaged over
LONGEST_S = 1.2  # a middle farther back than half of it cannot be gone back to
LEAST_LEVEL = 0.1  # share of the field; one that is steeper has no direction


class FieldStance(NamedTuple):
    """The field (3,) T in the axes of ``foot`` in the middle of a stance, at ``stamp_ns``."""

    foot: int
    stamp_ns: int
    measured: FloatArray


@dataclass(frozen=True)
class FieldAtStance(FieldDirection):
    """The direction of a field with what was measured, and by how much it turned each foot, rad.

    ``rotation`` is R_nb (3, 3) before.
    """

    stamp_ns: int = 0
    measured: FloatArray = field(default_factory=lambda: np.zeros(3))
    rotation: FloatArray = field(default_factory=lambda: np.eye(3))
    turned: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(cls, at: NavigationField, stance: FieldStance, rotation: FloatArray) -> FieldAtStance:
        """Return the direction of the field ``at`` navigation axes."""
        vector = (at.x, at.y, at.z)
        return cls(stance.foot, vector, at.angle, stance.stamp_ns, stance.measured, rotation)


class MagneticHeading(Method):
    """Observes the direction of the field in the middle of each stance."""

    memory_s = 0.5 * LONGEST_S
    needs_heading = True

    config: AidsConfig

    def __init__(
        self, config: AidsConfig, logs: Mapping[str, FieldLog], counters: Counter[str]
    ) -> None:
        """Read ``logs``, one for each foot; count in ``counters`` the stances that gave none."""
        self.config, self._logs, self._counters = config, logs, counters
        self._reference: list[NavigationField | None] = [None, None]
        self._first: list[list[NavigationField]] = [[], []]
        self._iron = [HardIron(), HardIron()]
        self._turned = [0.0, 0.0]  # of each foot, by all rows so far, rad
        self._in_a_row = [0, 0]  # stances of each foot, up to the last, that were alike

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the heading of the field in the middle of the stance, if it was measured."""
        foot, latest = stance.foot, stance.last - round(self.memory_s / stance.period_s)
        moment = max(stance.moment(0.5), latest)
        if not gait.remembers(moment):
            return ()
        measured = self._measured(stance, moment, gait)
        if measured is None:
            self._counters[Refusal.STANCES_WITHOUT_FIELD] += 1
            return ()

        trusted = self._in_a_row[foot] + 1 >= self.config.magnetic_stances

        stamp_ns, iron = gait.stamp(moment), self._iron[foot]
        earth = (iron.tesla, iron.field)  # as known now, whenever it is run again
        apply = partial(
            self._apply, stance=FieldStance(foot, stamp_ns, measured), trusted=trusted, earth=earth
        )
        return (Request(moment, True, apply, EventKind.AID),)

    def _measured(self, stance: StancePhase, moment: int, gait: Gait) -> FloatArray | None:
        """Return the mean field (3,) T around ``moment``, in the axes of the foot."""
        middle_ns = gait.stamp(moment)
        first_ns = max(middle_ns - AROUND_NS, gait.stamp(stance.first))
        last_ns = min(middle_ns + AROUND_NS, gait.stamp(stance.last))
        inside = self._logs[FEET[stance.foot]].between(first_ns, last_ns)
        return np.mean(inside, axis=0) if inside else None

    def _apply(
        self,
        estimate: JointEstimate,
        stance: FieldStance,
        trusted: bool,
        earth: tuple[FloatArray, NavigationField | None],
    ) -> Outcome:
        foot = stance.foot
        rotations = [estimate.rotation(k) for k in range(2)]
        field = NavigationField(*(rotations[foot] @ stance.measured).tolist())
        reference = self._reference[foot]
        direction = FieldAtStance.of(field, stance, rotations[foot])
        if reference is None:
            return nothing_done(direction, Reason.FIRST_STANCES)
        if not self._alike(field, reference):
            return nothing_done(direction, Reason.DISTURBED_FIELD)
        if not trusted:
            return nothing_done(direction, Reason.AFTER_DISTURBANCE)
        std = self.config.magnetic_std
        if earth[1] is not None:
            reference, std = earth[1], min(std, self.config.magnetic_iron_std)
            field = NavigationField(*(rotations[foot] @ (stance.measured - earth[0])).tolist())
        innovation = math.remainder(field.angle - reference.angle, math.tau)
        s, nis = estimate.update([heading_row(foot, field)], [innovation], [std**2])
        turned = [turn_between(rotations[k], estimate.rotation(k)) for k in range(2)]
        found = replace(direction, turned=(turned[0], turned[1]))
        return Outcome(np.array([innovation]), s, nis, True, found)

    def _alike(self, field: NavigationField, reference: NavigationField) -> bool:
        if field.level < LEAST_LEVEL * field.norm:
            return False
        size = abs(field.norm - reference.norm)
        dip = abs(field.dip - reference.dip)
        alike = size <= self.config.magnetic_size * reference.norm
        return alike and dip <= self.config.magnetic_dip

    def note(self, outcome: Outcome) -> None:
        """Learn the reference from the first stances that agree; count those that are refused."""
        direction = outcome.payload
        if not isinstance(direction, FieldAtStance):
            return
        foot, alike = direction.foot, outcome.reason is not Reason.DISTURBED_FIELD
        self._in_a_row[foot] = self._in_a_row[foot] + 1 if alike else 0
        if self._reference[foot] is None:
            self._learn(foot, NavigationField(*direction.field))
        elif not outcome.accepted:
            self._counters[Refusal.STANCES_IN_DISTURBED_FIELD] += 1
        else:
            self._learn_iron(direction)

    def _learn(self, foot: int, field: NavigationField) -> None:
        """Take the mean of the last stances for the reference, if they are all like it."""
        first, enough = self._first[foot], self.config.magnetic_stances
        first.append(field)
        del first[:-enough]
        mean = mean_field(first)
        if len(first) == enough and all(self._alike(each, mean) for each in first):
            self._reference[foot] = mean
        else:
            self._counters[Refusal.STANCES_BEFORE_FIELD_REFERENCE] += 1

    def _learn_iron(self, direction: FieldAtStance) -> None:
        """Tell iron from earth, with the attitude as it would be without any row."""
        foot, reference = direction.foot, self._reference[direction.foot]
        assert reference is not None
        free = about_z(-self._turned[foot]) @ direction.rotation
        self._iron[foot].add(direction.stamp_ns, free, direction.measured, reference)
        self._turned = [a + b for a, b in zip(self._turned, direction.turned, strict=True)]

    def moved(self, up_m: float, turned: float) -> None:
        """Turn the references with the track."""
        self._reference = [
            None if each is None else each.turned(turned) for each in self._reference
        ]
        self._first = [[each.turned(turned) for each in first] for first in self._first]
        self._iron = [HardIron(), HardIron()]
        self._turned = [0.0, 0.0]


def heading_row(foot: int, field: NavigationField) -> dict[int, float]:
    """Return the row of the direction of ``field`` for ``foot`` 0 or 1."""
    x, y, z = (attitude_row(foot, axis) for axis in range(3))
    steepness = field.z / field.level**2
    return {x: field.x * steepness, y: field.y * steepness, z: -1.0}
