"""What a session knows of the walk, as all that happens on the way asks and changes it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from ..carried import Carriage
from ..config import TrackerConfig
from ..constraints import METHODS, Method, Request
from ..constraints.at_passing import AtPassing
from ..gait_history import GaitHistory
from ..joint_estimate import JointEstimate, Outcome
from ..kernel import Engine, Workspace
from ..kernel import layout as lay
from ..misfit import MISFIT
from ..results.events import FEET, Event, EventKind
from ..results.facing import Facing
from ..results.payloads import Reason
from ..roll_back import Action, RollBack
from ..samples.increments import Increments
from ..samples.series import FloatArray
from .absence import Absences
from .heading import Headings, turn
from .initial_state import InitialState
from .standing import Stands


class WalkState:
    """The state of both feet, and those who look after a part of it."""

    def __init__(
        self,
        config: TrackerConfig,
        rate_hz: float,
        aids: Sequence[Method],
        increments: Sequence[Increments | None],
    ) -> None:
        """Make room for the feet; ``aids`` are asked as the method is."""
        self.method: Method = METHODS[config.method](config.constraint)
        self.aids = aids
        stance = config.stance
        memory = stance.min_stance + stance.min_swing + stance.window + 0.1
        memory = max(1.3, memory + max(each.memory_s for each in (self.method, *aids)))
        space = self.space = Workspace(rate_hz, memory)
        self.initial = InitialState(config, space, increments)
        self.headings = Headings(config.heading, space, self.initial)
        self.gait = GaitHistory(space)
        self.roll_back = RollBack(space)
        self.stands = Stands(config, space)
        self.carriage = Carriage(config.floor, space, self.gait, self.roll_back)
        self.absences = Absences(config, space, self.headings, self.gait)
        self.phase = "standing"
        self._facing: Facing | None = None
        self._followed = False  # headings have changed since

    @property
    def facing(self) -> Facing:
        """Where the feet head in their axes, as far as that is known."""
        if self._facing is None:
            self._facing = self.headings.facing()
        elif self._followed:
            self._facing = self._facing._replace(stances=self.headings.present)
        self._followed = False
        return self._facing

    def heading_changed(self) -> None:
        """Take note that `facing` is another one from now on."""
        self._facing = None

    def headings_followed(self) -> None:
        """Take note that both feet head elsewhere, and nothing else has changed of it."""
        self._followed = True

    def use(self, engine: Engine) -> None:
        """Go on with another form of the kernel."""
        self.engine = engine
        self.estimate = JointEstimate(self.space, engine)
        self.roll_back.use(engine, self.estimate)
        self._learn_with(engine)

    def _learn_with(self, engine: Engine) -> None:
        if self.method.spacing is not None:
            self.method.spacing.use(engine)

    def retune(self, config: TrackerConfig, aids: Sequence[Method]) -> None:
        """Go on with other weights, thresholds, aids and distances."""
        self.aids = aids
        self.initial.retune(config)
        self.method.retune(config.constraint)
        self._learn_with(self.engine)
        self.carriage.retune(config.floor)
        self.forget()

    def forget(self) -> None:
        """Go back to nothing that was before now: it cannot be run again as it was."""
        self.roll_back.forget()
        self.space.forget()

    @property
    def spacing(self) -> tuple[float, float] | None:
        """Distance of the feet side by side and its standard deviation, m, if it is in use."""
        spacing = self.method.spacing
        return None if spacing is None else (spacing.value_m, spacing.std_m)

    @property
    def coupled(self) -> bool:
        """Whether the feet may be constrained to each other."""
        return self.headings.known and self.absences.none

    @property
    def watches_floor(self) -> bool:
        """Whether two feet can tell now that they are carried."""
        walking = self.phase == "walking" and self.absences.none
        return self.carriage.watches and walking and not self.method.sensors_on_one_shoe

    def watch(self) -> None:
        """Have the kernel report when the method wants to know, once the heading is known."""
        limit = self.method.watch_m if self.coupled else math.inf
        self.space.w[lay.C_WATCH] = limit * abs(limit)

    def second_sensor(self, arm: FloatArray) -> FloatArray:
        """Return where the second sensor of a rigid pair is (3,), m."""
        return self.estimate.position(0) + self.estimate.rotation(0) @ arm

    def join_pair(self, now: int) -> list[Event]:
        """Put the second sensor of a rigid pair back beside the first, both having turned."""
        arm = self.method.lever_arm
        if arm is None:
            return []
        shift = self.second_sensor(arm) - self.estimate.position(1)
        return [turn(self.space, self.engine, 1, 0.0, np.zeros(3), shift, stamp=now)]

    def constrain(self, foot: str, method: Method, requests: Sequence[Request]) -> list[Event]:
        """Apply what a method asked for, and tell it and the caller what came of it."""
        if not requests:
            return []
        if len(requests) > 1 and requests[0].roll_back:
            requests = sorted(requests, key=lambda request: request.epoch)
        outcomes = self.roll_back.apply(requests, self.doubted)
        found = []
        for request, outcome in zip(requests, outcomes, strict=True):
            if outcome.reason is not Reason.DID_NOT_FIT:
                method.note(outcome)
            self.carriage.constrained(outcome)
            found.append(self._event(foot, request, outcome))
        return found

    def end_in_kernel(self, foot: int, now: int) -> list[Event] | None:
        """Let the kernel do what the method would ask for at the end of the stance of ``foot``.

        None where it is to be asked; ``now`` is the newest stamp.
        """
        method = self.method
        if not isinstance(method, AtPassing) or method.rule is None or self.aids:
            return None
        if not self.coupled:
            return None
        heading, doubted, roll_back = self.headings.mean, self.doubted, self.roll_back
        done, found = self.estimate.end_stance(
            method.rule,
            method.spacing.numbers,
            foot,
            heading,
            MISFIT if doubted else math.inf,
            roll_back.newest,
        )
        if done != lay.END_DONE:
            return None if done == lay.END_ASK else []
        moment, target = self.space.n.item(lay.N_MOMENT), found[lay.X_TARGET]
        outcome = method.outcome(self.estimate, found, target, heading)
        if outcome.accepted:
            apply = partial(method.apply, target=target, heading=heading)
            roll_back.note(Action(moment, apply, doubted))
        return [Event(EventKind.CONSTRAINT, self.gait.stamp(moment), FEET[foot], now, *outcome)]

    @property
    def doubted(self) -> Sequence[int]:
        """The feet that may be elsewhere, where a constraint does not fit.

        Where stamps are uneven, a misfit tells nothing: the covariance knows too little all the
        time.
        """
        return () if self.gait.uneven else (0, 1)

    def _event(self, foot: str, request: Request, outcome: Outcome) -> Event:
        return Event(
            request.kind,
            self.gait.stamp(request.epoch),
            foot,
            self.gait.stamp(self.space.epoch),
            *outcome,
        )
