"""A tracker that has been aligned: it runs epochs and attends to what they report.

What needs the future is done here, with the kernel's ring of snapshots: a stance or swing too
short to be one is undone, and a constraint can be applied at the moment it is about.  In both
cases the filter goes back, is corrected, and runs again over the few epochs since; constraints
that were applied in between are applied again at their own epochs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from .alignment import Standstill
from .config import TrackerConfig
from .constraints import METHODS
from .constraints.method import Request, StancePhase
from .estimate import JointEstimate, Outcome
from .heading import FirstStrides
from .kernel import Engine
from .kernel import layout as at
from .series import FloatArray, IntArray
from .trajectory import FEET, Event, EventKind
from .workspace import Workspace

Found = list[Event]


class Session:
    """The tracking of two feet from one alignment on."""

    def __init__(
        self, config: TrackerConfig, engine: Engine, still: Standstill, rate_hz: float
    ) -> None:
        """Level both feet from ``still``."""
        module = METHODS[config.method]
        self._method = module.Method(config.constraint) if hasattr(module, "Method") else None
        stance = config.stance
        memory = stance.min_stance + stance.min_swing + stance.window + 0.1
        memory += self._method.memory_s if self._method else 0.0
        self.rate_hz = rate_hz
        self.space = Workspace(config, rate_hz, memory)
        self.phase = "standing"
        self.headings = (config.heading.given, config.heading.given)
        self._config, self._still = config, still
        self._origin, self._forward = np.zeros(3), config.heading.given
        known = config.heading.source == "sensor"
        self._strides = [None if known else FirstStrides(config.heading) for _ in FEET]
        self._offsets = [0.0, 0.0]
        self._actions: list[tuple[int, Callable[[JointEstimate], Outcome]]] = []
        self._dt, self._values = np.empty(1), np.empty((1, 12))
        self._row = np.zeros((1, at.OUT))
        self.use(engine)
        self._level()

    def use(self, engine: Engine) -> None:
        """Go on with another form of the kernel."""
        self._engine = engine
        self._estimate = JointEstimate(self.space, engine)

    def _level(self) -> None:
        self.space.level(self._config, self._still.result(), self._origin, self._forward)

    def aligned_event(self, stamp: int) -> Event:
        """Return the event that says what the alignment found."""
        detail = {}
        for name, still in zip(FEET, self._still.result(), strict=True):
            detail[f"{name}_gyro_bias"] = still.angular_rate.tolist()
            detail[f"{name}_gravity"] = float(np.linalg.norm(still.specific_force))
        return Event(EventKind.ALIGNED, stamp, "both", stamp, detail=detail)

    # --- running ---------------------------------------------------------------------------------

    def step(self, stamp: int, dt_s: float, values: FloatArray) -> tuple[FloatArray, Found]:
        """Run one epoch; return its output row (OUT,) and the events it brought."""
        if self.phase == "standing" and self._still.add(values, restart=False):
            self._level()
        self._dt[0] = dt_s
        self._values[0] = values
        space = self.space
        self._engine.advance(space.w, space.n, self._dt, self._values, 0, 1, self._row)
        space.stamps[space.n[at.N_EPOCH] % space.ring] = stamp
        found: Found = []
        if space.n[at.N_NOTICE]:
            found = self._attend()
            self._engine.emit(space.w, space.n, self._row, 0)
        return self._row[0].copy(), found

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
            if space.n[at.N_NOTICE]:
                found = self._attend()
                self._engine.emit(space.w, space.n, out, k - 1)
                if found:
                    yield k - 1, found

    # --- attending to notices ----------------------------------------------------------------------

    def _attend(self) -> Found:
        """Do what the newest epoch's notices ask for."""
        notices = int(self.space.n[at.N_NOTICE])
        bits = [notices & 15, notices >> at.NOTICE_SHIFT]
        self._clean_phases(bits)
        found: Found = []
        for foot in range(2):
            if bits[foot] & at.STANCE_CONFIRMED:
                found += self._stance_confirmed(foot)
            elif bits[foot] & at.STANCE_ENDED:
                found += self._stance_ended(foot)
        return found

    def _clean_phases(self, bits: list[int]) -> None:
        """Undo the zero velocity of a stance, or the swing within one, that was none."""
        space, now = self.space, self.space.epoch
        firsts = []
        for foot in range(2):
            if bits[foot] & at.STANCE_FALSE:
                first = space.foot(foot, "N_START")
                still = False
            elif bits[foot] & at.SWING_FALSE:
                first = space.foot(foot, "N_LEAVE")
                still = True
            else:
                continue
            if first >= space.oldest:
                self._engine.set_flags(space.n, foot, first, now, still)
                firsts.append(first)
        if firsts:
            self._engine.restore(space.w, space.n, min(firsts))
            self._replay(min(firsts))

    def _replay(self, first: int) -> None:
        """Run epochs ``first``..newest again from the present state, constraints included."""
        space, engine = self.space, self._engine
        for epoch, apply in self._actions:
            if epoch >= first:
                engine.rerun(space.w, space.n, first, epoch)
                apply(self._estimate)
                first = epoch + 1
        engine.rerun(space.w, space.n, first, space.epoch)

    def _stance_confirmed(self, foot: int) -> Found:
        stamp = self._stamp(self.space.foot(foot, "N_START"))
        now = self._stamp(self.space.epoch)
        found = [Event(EventKind.STANCE_START, stamp, FEET[foot], now)]
        strides = self._strides[foot]
        if strides is not None:
            direction = strides.add(self._estimate.position(foot))
            if direction is not None:
                self._strides[foot] = None
                found.append(self._turn_to_first_strides(foot, direction, strides))
        self._update_heading(foot)
        return found

    def _stance_ended(self, foot: int) -> Found:
        space = self.space
        first, last = space.foot(foot, "N_START"), space.foot(foot, "N_LEAVE") - 1
        now = self._stamp(space.epoch)
        end = Event(EventKind.STANCE_END, self._stamp(last, now), FEET[foot], now)
        self.phase = "walking"
        found = [end]
        if self._method is not None and self.headed:
            lag = 0.5 * (int(space.n[at.N_WINDOW]) - 1)
            stance = StancePhase(foot, first, last, lag, space.epoch, 1.0 / self.rate_hz)
            request = self._method.on_stance_end(stance, self)
            if request is not None:
                found.append(self._constrain(foot, request))
        return found

    def _constrain(self, foot: int, request: Request) -> Event:
        space = self.space
        if request.roll_back:
            self._engine.restore(space.w, space.n, request.epoch + 1)
        outcome = request.apply(self._estimate)
        applied_at = request.epoch if request.roll_back else space.epoch
        if request.roll_back:
            self._replay(request.epoch + 1)
        if outcome.accepted:
            self._actions = [a for a in self._actions if a[0] >= space.oldest]
            self._actions.append((applied_at, request.apply))
            self._actions.sort(key=lambda action: action[0])
        return Event(
            EventKind.CONSTRAINT,
            self._stamp(request.epoch),
            FEET[foot],
            self._stamp(space.epoch),
            outcome.innovation,
            outcome.S,
            outcome.nis,
            outcome.accepted,
            outcome.detail,
        )

    # --- what methods may ask (constraints.method.Gait) -------------------------------------------

    def in_stance(self, foot: int, epoch: int) -> bool:
        """Return whether ``foot`` had zero velocity at ``epoch``."""
        return bool((int(self.space.n[at.N_FLAGS + epoch % self.space.ring]) >> foot) & 1)

    def remembers(self, epoch: int) -> bool:
        """Return whether the filter can be rolled back to just after ``epoch``."""
        return self.space.oldest <= epoch + 1 <= self.space.epoch

    def positions_after(self, epoch: int) -> FloatArray:
        """Return both feet's positions (2, 3) m as estimated at ``epoch``."""
        state = self.space.snapshot(epoch + 1)
        return np.array([state[f * at.FOOT + at.POS : f * at.FOOT + at.POS + 3] for f in (0, 1)])

    def _stamp(self, epoch: int, default: int = 0) -> int:
        space = self.space
        if not space.epoch - space.ring < epoch <= space.epoch:
            return default
        return int(space.stamps[epoch % space.ring])

    # --- heading and pose --------------------------------------------------------------------------

    @property
    def headed(self) -> bool:
        """Whether both feet know their heading."""
        return self._strides[0] is None and self._strides[1] is None

    def _turn_to_first_strides(self, foot: int, direction: float, strides: FirstStrides) -> Event:
        return self._turn(foot, self._forward - direction, strides.pivot, np.zeros(3))

    def _turn(self, foot: int, yaw: float, pivot: FloatArray, shift: FloatArray) -> Event:
        """Turn the present state and every snapshot; the event tells what to do to the rest."""
        space, c, s = self.space, math.cos(yaw), math.sin(yaw)
        for start in space.states():
            self._engine.turn(space.w, start, foot, c, s, pivot, shift)
        self._offsets[foot] = self._sensor_yaw(foot) - self._forward
        now = self._stamp(space.epoch)
        detail = {
            "yaw": yaw,
            "pivot": (float(pivot[0]), float(pivot[1]), 0.0),
            "shift": tuple(float(v) for v in shift),
        }
        return Event(EventKind.HEADING, now, FEET[foot], now, detail=detail)

    def _sensor_yaw(self, foot: int) -> float:
        w, rotation = self.space.w, foot * at.FOOT + at.ROT
        return math.atan2(w[rotation + 3], w[rotation])

    def _update_heading(self, foot: int) -> None:
        if self._strides[foot] is None and self.phase == "walking":
            headings = list(self.headings)
            headings[foot] = self._sensor_yaw(foot) - self._offsets[foot]
            self.headings = (headings[0], headings[1])

    def can_set_pose(self) -> bool:
        """Return whether `set_pose` can be obeyed now: standing, or the heading is known."""
        return self.phase == "standing" or self.headed

    def set_pose(self, stamp: int, position: FloatArray, yaw: float) -> Found:
        """Put the person at ``position`` (3,) m facing ``yaw``; return the turns of both tracks."""
        if self.phase == "standing":
            self._origin, self._forward = position, yaw
            self.headings = (yaw, yaw)
            self._level()
            return []
        feet = [self._estimate.position(foot) for foot in range(2)]
        middle = 0.5 * (feet[0] + feet[1])
        a, b = self.headings
        turn = yaw - math.atan2(math.sin(a) + math.sin(b), math.cos(a) + math.cos(b))
        offsets = list(self._offsets)
        found = [self._turn(foot, turn, middle, position - middle) for foot in range(2)]
        self._offsets, self.headings = offsets, (a + turn, b + turn)
        self._actions.clear()
        self.space.n[at.N_OLDEST] = self.space.epoch + 1
        return found

    def bridge(self, gap_s: float) -> Found:
        """Get over a gap in the data: nothing is known of what the feet did meanwhile."""
        space = self.space
        last = self._stamp(space.epoch)
        found = [
            Event(EventKind.STANCE_END, last, FEET[foot], last)
            for foot in range(2)
            if space.foot(foot, "N_PHASE") in (at.STANCE, at.LEAVING)
        ]
        space.bridge(gap_s)
        self._actions.clear()
        return found
