"""A tracker that has been aligned: it runs epochs and attends to what they report.

What needs the future is done here, by going back (``roll_back``): a stance or swing too short to
be one is undone, and a constraint can be applied at the moment it is about.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from .absence import Absences, Presence
from .alignment import Alignment, Start
from .carried import Carriage
from .config import TrackerConfig
from .constraints import METHODS, Method, Request, StancePhase
from .gait_history import GaitHistory
from .given_pose import GivenPose, apply_covariance
from .heading import Headings, turn
from .initial_state import InitialState
from .joint_estimate import JointEstimate, Outcome
from .kernel import Engine, Workspace
from .kernel import layout as lay
from .results.events import FEET, Event, EventKind
from .results.payloads import Levelled
from .roll_back import RollBack
from .samples.increments import Increments
from .samples.series import FloatArray, IntArray
from .standing import Stands

Found = list[Event]
LONGEST_STEP = 1.7  # of the nominal interval: longer ones are holes


class Session:
    """The tracking of two feet from one alignment on."""

    def __init__(
        self,
        config: TrackerConfig,
        engine: Engine,
        start: Start,
        alignment: Alignment | None = None,
        aids: Sequence[Method] = (),
        increments: Sequence[Increments | None] = (None, None),
    ) -> None:
        """Level both feet from ``start``; ``aids`` are asked as the method is.

        ``alignment`` goes on refining a stand; ``increments`` is what the sources of both feet
        say that their samples are.
        """
        self._method: Method = METHODS[config.method](config.constraint)
        stance = config.stance
        memory = stance.min_stance + stance.min_swing + stance.window + 0.1
        memory = max(1.3, memory + max(each.memory_s for each in (self._method, *aids)))
        self._aids = aids
        self.rate_hz = start.rate_hz
        self.space = Workspace(start.rate_hz, memory)
        self._initial = InitialState(config, self.space, increments)
        self.phase = "standing"
        self._standing_start = [not start.waiting] * 2
        self.headings = Headings(config.heading, self.space, self._initial)
        self._config, self._start, self._alignment = config, start, alignment
        self._feet = start.feet
        self._origin = np.zeros(3)
        self._pose_covariance: FloatArray | None = None
        self._gait = GaitHistory(self.space)
        self._roll_back = RollBack(self.space)
        self._stands = Stands(config, self.space)
        self._carriage = Carriage(config.floor, self.space, self._gait, self._roll_back)
        self.absences = Absences(config, self.space, self.headings, self._gait)
        self.filled_ns = 0
        self._dt, self._values = np.empty(1), np.empty((1, 12))
        self._row = np.zeros((1, lay.OUT))
        self.use(engine)
        self._level()
        for foot, still in enumerate(start.feet):
            if still.absent:
                self.absences.never_there(foot, still.end_ns)
        self.facing = self.headings.facing()

    @property
    def spacing(self) -> tuple[float, float] | None:
        """Distance of the feet side by side and its standard deviation, m, if it is in use."""
        spacing = self._method.spacing
        return None if spacing is None else (spacing.value_m, spacing.std_m)

    def retune(self, config: TrackerConfig, aids: Sequence[Method]) -> None:
        """Go on with other weights, thresholds, aids and distances."""
        self._config, self._aids = config, aids
        self._initial.retune(config)
        self._method.retune(config.constraint)
        self._carriage.retune(config.floor)
        self._roll_back.forget()
        self.space.forget()

    def use(self, engine: Engine) -> None:
        """Go on with another form of the kernel."""
        self._engine = engine
        self._estimate = JointEstimate(self.space, engine)
        self._roll_back.use(engine, self._estimate)

    def _level(self) -> None:
        forward = self.headings.forward
        self._initial.level(self._feet, self._origin, forward)
        arm = self._method.lever_arm
        if arm is not None:
            self._estimate.place(1, self._second_sensor(arm))
        if self._pose_covariance is not None:
            apply_covariance(self.space, self._pose_covariance, replace=False)
        self.headings.levelled()
        self.facing = self.headings.facing()
        self._watch()

    def _second_sensor(self, arm: FloatArray) -> FloatArray:
        """Return where the second sensor of a rigid pair is (3,), m."""
        return self._estimate.position(0) + self._estimate.rotation(0) @ arm

    def _join_pair(self, now: int) -> Found:
        """Put the second sensor of a rigid pair back beside the first, both having turned."""
        arm = self._method.lever_arm
        if arm is None:
            return []
        shift = self._second_sensor(arm) - self._estimate.position(1)
        return [turn(self.space, self._engine, 1, 0.0, np.zeros(3), shift, stamp=now)]

    def _watch(self) -> None:
        """Have the kernel report when the method wants to know, once the heading is known."""
        limit = self._method.watch_m if self._coupled else math.inf
        self.space.w[lay.C_WATCH] = limit * abs(limit)

    @property
    def _coupled(self) -> bool:
        """Whether the feet may be constrained to each other."""
        return self.headings.known and self.absences.none

    def aligned_event(self, stamp: int) -> Event:
        """Return the event that says what the alignment found."""
        feet = dict(zip(FEET, self._feet, strict=True))
        levelled = Levelled(
            str(self._start.kind),
            {name: still.angular_rate.tolist() for name, still in feet.items()},
            {name: float(np.linalg.norm(still.specific_force)) for name, still in feet.items()},
            max(still.rate_std for still in feet.values()),
            self.rate_hz,
        )
        return Event(EventKind.ALIGNED, stamp, "both", stamp, payload=levelled)

    # --- running ---------------------------------------------------------------------------------

    def step(self, stamp: int, dt_s: float, values: FloatArray) -> tuple[FloatArray, Found]:
        """Run one epoch; return its output row (OUT,) and the events it brought."""
        if self.phase == "standing":
            self._refine(stamp, values)
        space, n = self.space, self.space.n
        self._dt[0] = dt_s
        self._values[0] = values
        self._engine.advance(space.w, n, self._dt, self._values, 0, 1, self._row)
        space.stamps[n[lay.N_EPOCH] % space.ring] = stamp
        found: Found = []
        if n[lay.N_NOTICE]:
            found = self._attend()
            self._engine.emit(space.w, n, self._row, 0)
        return self._row[0].copy(), found

    def _refine(self, stamp: int, values: FloatArray) -> None:
        """Level anew when the stand has gone on for a window's length more."""
        alignment = self._alignment
        if alignment is None or not math.isfinite(values.sum()):
            self._alignment = None
        elif alignment.refine(stamp, values):
            self._feet = alignment.result()
            self._level()

    def steps(
        self,
        stamps: IntArray,
        dts: FloatArray,
        values: FloatArray,
        span: tuple[int, int],
        out: FloatArray,
    ) -> Iterator[tuple[int, Found]]:
        """Run the epochs of ``span`` [start, stop) into ``out``; yield rows that brought events.

        ``dts`` (N,) s are the intervals that end at each sample.
        """
        space = self.space
        k, stop = span
        while k < stop:
            first = space.epoch + 1
            done = self._engine.advance(space.w, space.n, dts, values, k, stop, out)
            tail = max(k, done - space.ring)
            epochs = np.arange(first + tail - k, first + done - k)
            space.stamps[epochs % space.ring] = stamps[tail:done]
            k = done
            if space.n[lay.N_NOTICE]:
                found = self._attend()
                self._engine.emit(space.w, space.n, out, k - 1)
                if found:
                    yield k - 1, found

    # --- attending to notices -------------------------------------------------------------------

    def _attend(self) -> Found:
        """Do what the newest epoch's notices ask for."""
        notices = int(self.space.n[lay.N_NOTICE])
        bits = [notices & 15, notices >> lay.NOTICE_SHIFT]
        self._roll_back.clean_phases(bits)
        found = self._attend_presence(notices)
        if notices & lay.NOTICE_FLOOR:
            found += self._attend_floor()
        for foot in range(2):
            if notices & (lay.NOTICE_STOOD << foot):
                self._stands.take(foot, self._gait.stamp(self.space.epoch))
            if bits[foot] & lay.STANCE_CONFIRMED:
                found += self._stance_confirmed(foot)
            elif bits[foot] & lay.STANCE_ENDED:
                found += self._stance_ended(foot)
        if notices & lay.NOTICE_WATCH and self._coupled:
            found += self._constrain("both", self._method, self._method.on_epoch(self._gait))
        return found

    @property
    def _watches_floor(self) -> bool:
        """Whether two feet can tell now that they are carried."""
        walking = self.phase == "walking" and self.absences.none
        return self._carriage.watches and walking and not self._method.sensors_on_one_shoe

    def _attend_floor(self) -> Found:
        """Attend to what both standing feet have gained."""
        if self._watches_floor:
            return self._carriage.window()
        self.space.w[lay.F_SECONDS] = 0.0
        return []

    def _attend_presence(self, notices: int) -> Found:
        """Attend to feet that are without samples, or that have samples again."""
        found: Found = []
        stamp = self._gait.stamp(self.space.epoch)
        for foot in range(2):
            if notices & (lay.NOTICE_GONE << foot):
                standing = bool((notices >> (foot * lay.NOTICE_SHIFT)) & lay.STANCE_ENDED)
                found.append(self.absences.gone(foot, stamp, standing=standing))
            elif notices & (lay.NOTICE_BACK << foot):
                # Before its first sample is used: that may be a ZUPT.
                self._roll_back.before_newest(partial(self.absences.back, foot, stamp))
            else:
                continue
            self._carriage.interrupted()
            self._roll_back.forget()
            self.space.forget()
            self._watch()
            self.facing = self.headings.facing()
        return found

    def _phase(self, foot: int, last: int) -> StancePhase:
        space = self.space
        lag = 0.5 * (int(space.n[lay.N_WINDOW]) - 1)
        first = space.foot(foot, "N_START")
        period, heading = self._gait.period_s, self.headings.mean
        return StancePhase(foot, first, last, lag, space.epoch, period, heading)

    def _stance_confirmed(self, foot: int) -> Found:
        stamp = self._gait.stamp(self.space.foot(foot, "N_START"))
        now = self._gait.stamp(self.space.epoch)
        found = [Event(EventKind.STANCE_START, stamp, FEET[foot], now)]
        walking = self.phase == "walking"
        if self._watches_floor:
            found += self._carriage.landed(foot, heading_known=self.headings.known)
        if self.absences.of[foot] is Presence.BACK:
            self.absences.level(foot)
            self._roll_back.forget()
            self.space.forget()
        turned = self.headings.stance(self._engine, foot, now, walking)
        self.facing = self.headings.facing()
        if turned and self.headings.known:
            turned += self._join_pair(now)
            self._watch()
        found += turned
        phase = self._phase(foot, self.space.epoch)
        for method in self._askable(foot):
            found += self._constrain(FEET[foot], method, method.on_stance_start(phase, self._gait))
        return found

    def _askable(self, foot: int) -> list[Method]:
        """Return the aids and the method, those that need the heading once it is known.

        The method needs both feet, and the aids the one that stands.
        """
        known = self.headings.known
        joined = self.absences.of[foot] is Presence.JOINED
        aids = [each for each in self._aids if joined and (known or not each.needs_heading)]
        free = known or not self._method.needs_heading
        return [*aids, self._method] if free and self.absences.none else aids

    def _stance_ended(self, foot: int) -> Found:
        last = self.space.foot(foot, "N_LEAVE") - 1
        now = self._gait.stamp(self.space.epoch)
        found = [Event(EventKind.STANCE_END, self._gait.stamp(last, now), FEET[foot], now)]
        self.phase = "walking"
        self._gait.ended[foot] = last
        found += self._learn_bias(foot, now)
        phase = self._phase(foot, last)
        for method in self._askable(foot):
            found += self._constrain(FEET[foot], method, method.on_stance_end(phase, self._gait))
        if self.absences.can_join(foot):
            found += self._join(foot, phase, now)
        return found

    def _join(self, foot: int, phase: StancePhase, now: int) -> Found:
        """Put a foot that is back beside the other one, where that passed it."""
        found: Found = []
        if self.absences.of[1 - foot] is Presence.JOINED:
            moment = phase.moment(0.5)
            if not self._gait.remembers(moment):
                return []
            spacing = self.spacing[0] if self.spacing else 0.0
            beside = partial(self.absences.put_beside, foot=foot, spacing_m=spacing)
            self._roll_back.apply([Request(moment, True, beside)])
        found.append(self.absences.joined(foot, now))
        self._watch()
        self.facing = self.headings.facing()
        return found

    def _learn_bias(self, foot: int, now: int) -> Found:
        """Learn the gyro bias from the stand that has ended, unless it was that of the start."""
        if self._standing_start[foot] or not self._stands.stood(foot):
            self._standing_start[foot] = False
            self._stands.forget(foot)
            return []
        return [self._stood_event(foot, now, self._stands.learn(foot, self._estimate))]

    def _stood_event(self, foot: int, now: int, outcome: Outcome) -> Event:
        return Event(
            EventKind.STOOD,
            now,
            FEET[foot],
            now,
            outcome.innovation,
            outcome.S,
            outcome.nis,
            payload=outcome.payload,
        )

    def _constrain(self, foot: str, method: Method, requests: Sequence[Request]) -> Found:
        """Apply what a method asked for, and tell it and the caller what came of it."""
        if not requests:
            return []
        done = self._roll_back.apply(requests)
        for _, outcome in done:
            method.note(outcome)
            self._carriage.constrained(outcome)
        return [self._event(foot, *pair) for pair in done]

    def _event(self, foot: str, request: Request, outcome: Outcome) -> Event:
        return Event(
            request.kind,
            self._gait.stamp(request.epoch),
            foot,
            self._gait.stamp(self.space.epoch),
            outcome.innovation,
            outcome.S,
            outcome.nis,
            outcome.accepted,
            outcome.payload,
            outcome.reason,
        )

    # --- pose and gaps ---------------------------------------------------------------------------

    def can_set_pose(self) -> bool:
        """Return whether `set_pose` can be obeyed now: standing, or the heading is known."""
        return self.phase == "standing" or self.headings.known

    def set_pose(self, stamp: int, pose: GivenPose) -> Found:
        """Put the person where the ``pose`` says; return both tracks' turns."""
        position, yaw = pose.position, pose.yaw
        if self.phase == "standing":
            up_m = float(position[2] - self._origin[2])
            turned = yaw - self.headings.forward
            self._origin, self._pose_covariance = position, pose.covariance
            self.headings.face(yaw)
            self._level()
            found: Found = []
        else:
            found = self.headings.set_pose(self._engine, position, yaw, stamp)
            if pose.covariance is not None:
                apply_covariance(self.space, pose.covariance, replace=True)
            self.facing = self.headings.facing()
            up_m, turned = found[0].turn.shift[2], found[0].turn.yaw
        for method in (*self._aids, self._method):
            method.moved(up_m, turned)
        self._roll_back.forget()
        self.space.forget()
        return found

    @property
    def period_ns(self) -> int:
        """Nominal interval of the samples, ns."""
        return round(1e9 / self.rate_hz)

    @property
    def longest_ns(self) -> int:
        """Interval between two samples above which some are missing between them, ns."""
        return round(LONGEST_STEP * 1e9 / self.rate_hz)

    def fill(self, stamp: int, dt_ns: int, values: FloatArray) -> Found:
        """Run epochs on the line between the sample before and that of ``stamp`` (12,).

        What they cannot know of the motion goes into the covariance.  The newest sample itself
        remains to be run, with an interval of ``filled_ns``.
        """
        space = self.space
        start = lay.RINGS + lay.SAMPLE * (space.epoch % space.ring) + 1
        before = space.w[start : start + 12].copy()
        count = max(1, round(dt_ns * 1e-9 * self.rate_hz))
        self.filled_ns = dt_ns // count
        found: Found = []
        for k in range(1, count):
            between = before + (values - before) * (k / count)
            at = stamp - (count - k) * self.filled_ns
            found += self.step(at, self.filled_ns * 1e-9, between)[1]
        if count > 1:
            space.blur(dt_ns * 1e-9 - 1.0 / self.rate_hz, values - before)
        return found

    def bridge(self, gap_s: float) -> Found:
        """Get over a gap in the data: nothing is known of what the feet did meanwhile."""
        space = self.space
        last = self._gait.stamp(space.epoch)
        found: Found = []
        for foot in range(2):
            standing = space.foot(foot, "N_PHASE") in (lay.STANCE, lay.LEAVING)
            if standing:
                found.append(Event(EventKind.STANCE_END, last, FEET[foot], last))
            if self.absences.of[foot] is not Presence.MISSING:
                self.absences.gone(foot, last, standing=standing)
                self.absences.back(foot, last + round(gap_s * 1e9))
        space.bridge(gap_s)
        self._carriage.interrupted()
        self._roll_back.forget()
        self._watch()
        return [*found, Event(EventKind.BRIDGED, last, "both", last + round(gap_s * 1e9))]
