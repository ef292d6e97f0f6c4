"""``barometer``: the height of a standing foot from air pressure.

Chen, Liu, Guo 2024, section 2.3: the height is observed while the foot stands, relative to the
first stance.  Each stance gives it once, as the mean over its samples; in swing the air that
streams past the shoe changes the pressure.  A foot uses the sensor it wears, and one worn on the
body where it has none; each has a reference of its own, for two sensors differ by metres.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from ..constraints.method import Gait, Method, Request, StancePhase
from ..groups import AidsConfig
from ..joint_estimate import JointEstimate, Outcome, nothing_done
from ..kernel.layout import position_row
from ..refusals import Refusal
from ..results.events import FEET, EventKind
from ..results.payloads import PressureHeight, Reason
from .pressure import PressureLog

WORN = (*FEET, "both")  # where a sensor is: "both" serves both feet
LONGEST_NS = 30_000_000_000  # of a stance; over more the weather changes


class Barometer(Method):
    """Observes each stance's mean pressure height against the first stance's."""

    needs_heading = False

    config: AidsConfig

    def __init__(
        self, config: AidsConfig, logs: Mapping[str, PressureLog], counters: Counter[str]
    ) -> None:
        """Read ``logs``, one for each of WORN; count stances without pressure in ``counters``."""
        self.config, self._logs, self._counters = config, logs, counters
        self._began_ns: list[int | None] = [None, None]
        self._zero: dict[tuple[int, str], float] = {}

    def on_stance_start(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Remember when the stance began."""
        self._began_ns[stance.foot] = gait.stamp(stance.first, gait.stamp(gait.now))
        return ()

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the stance's mean height, if enough samples fell into it."""
        foot, last_ns = stance.foot, gait.stamp(stance.last)
        began_ns, self._began_ns[foot] = self._began_ns[foot], None
        if began_ns is None or not gait.remembers(stance.last):
            return ()
        worn, inside = self._measured(foot, max(began_ns, last_ns - LONGEST_NS), last_ns)
        if len(inside) < self.config.barometer_samples:
            self._counters[Refusal.STANCES_WITHOUT_PRESSURE] += 1
            return ()
        height = sum(inside) / len(inside)
        apply = partial(self._apply, foot=foot, worn=worn, height=height)
        return (Request(stance.last, True, apply, EventKind.AID),)

    def _measured(self, foot: int, first_ns: int, last_ns: int) -> tuple[str, list[float]]:
        """Return the heights of the foot's own sensor, or of the body's where it has too few."""
        own = self._logs[FEET[foot]].between(first_ns, last_ns)
        if len(own) >= self.config.barometer_samples:
            return FEET[foot], own
        return "both", self._logs["both"].between(first_ns, last_ns)

    def _apply(self, estimate: JointEstimate, foot: int, worn: str, height: float) -> Outcome:
        z = float(estimate.position(foot)[2])
        measured = PressureHeight(worn, height)
        if (foot, worn) not in self._zero:
            self._zero[foot, worn] = height - z
            return nothing_done(measured, Reason.FIRST_STANCE)
        innovation = z - (height - self._zero[foot, worn])
        rows, variance = [{position_row(foot, 2): 1.0}], self.config.barometer_std**2
        s, nis = estimate.update(rows, [innovation], [variance])
        return Outcome(np.array([innovation]), s, nis, True, measured)

    def moved(self, up_m: float, turned: float) -> None:
        """Move the reference heights with the track."""
        self._zero = {key: zero - up_m for key, zero in self._zero.items()}
