"""``flat_floor``: a standing foot is on the floor, and stays where it is.

Ma and Särkkä 2023, II-B: during the stance the height is zero and the horizontal position does not
change.  Their pseudo-measurement at every sample claims the same centimetre over and over; here
each stance gives it once: the height when the stance is confirmed, and, with ``static_std``, at
its end the horizontal position it had then.  For level ground only: on stairs it is wrong, and off
by default.

The place is an estimate of the filter's own, taken for a measurement: it makes the position look
as well known as a foot stands still.  What a stance tells of a place the zero-velocity updates
have said already, so it is used where a paper is to be followed and nowhere else.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ..constraints.method import Gait, Method, Request, StancePhase
from ..groups import AidsConfig
from ..joint_estimate import JointEstimate, Outcome
from ..kernel.layout import position_row
from ..results.events import EventKind
from ..results.payloads import Details
from ..samples.series import FloatArray

HEIGHT = Details({"aid": "flat_floor", "what": "height"})
PLACE = Details({"aid": "flat_floor", "what": "place"})


class FlatFloor(Method):
    """Observes the floor's height and a standing foot's place."""

    needs_heading = False

    config: AidsConfig

    def __init__(self, config: AidsConfig) -> None:
        """Use ``config.floor_std`` and ``config.static_std``."""
        self.config = config
        self._stood: list[FloatArray | None] = [None, None]
        self._floor_m = 0.0

    def on_stance_start(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the height of the floor, now."""
        apply = partial(self._stand, foot=stance.foot)
        return (Request(gait.now, False, apply, EventKind.AID),)

    def on_stance_end(self, stance: StancePhase, gait: Gait) -> Sequence[Request]:
        """Return the place the foot stood at, at the end of the stance."""
        stood, self._stood[stance.foot] = self._stood[stance.foot], None
        if stood is None or not self.config.static_std or not gait.remembers(stance.last):
            return ()
        apply = partial(self._place, foot=stance.foot, place=stood)
        return (Request(stance.last, True, apply, EventKind.AID),)

    def _stand(self, estimate: JointEstimate, foot: int) -> Outcome:
        outcome = self._height(estimate, foot)
        self._stood[foot] = estimate.position(foot)
        return outcome

    def _height(self, estimate: JointEstimate, foot: int) -> Outcome:
        innovation = estimate.position(foot)[2:] - self._floor_m
        rows = [{position_row(foot, 2): 1.0}]
        s, nis = estimate.update(rows, innovation.tolist(), [self.config.floor_std**2])
        return Outcome(innovation, s, nis, True, HEIGHT)

    def _place(self, estimate: JointEstimate, foot: int, place: FloatArray) -> Outcome:
        innovation = (estimate.position(foot) - place)[:2]
        rows = [{position_row(foot, axis): 1.0} for axis in (0, 1)]
        s, nis = estimate.update(rows, innovation.tolist(), [self.config.static_std**2] * 2)
        return Outcome(innovation, s, nis, True, PLACE)

    def moved(self, up_m: float, turned: float) -> None:
        """Move the floor with the track."""
        self._floor_m += up_m
        self._stood = [None, None]
