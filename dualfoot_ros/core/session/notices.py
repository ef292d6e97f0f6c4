"""What a session does when the kernel reports something: a stance, a passing, a foot without data.

What needs the future is done by going back (``RollBack``): a stance or swing too short to be one
is undone, and a constraint can be applied at the moment it is about.
"""

from __future__ import annotations

from functools import partial

from ..carried.boarding import LANDING_STD
from ..constraints import Method, Request, StancePhase
from ..joint_estimate import Outcome
from ..kernel import layout as lay
from ..kernel.at_stances.stance_end import lag_of
from ..results.events import FEET, Event, EventKind
from .absence import Presence
from .lost_track import LOST_GATE, lost_speed
from .walk_state import WalkState

Found = list[Event]
FALSE = (lay.STANCE_FALSE | lay.SWING_FALSE) * (1 + (1 << lay.NOTICE_SHIFT))
PRESENCE = 3 * (lay.NOTICE_GONE | lay.NOTICE_BACK)  # bits of both feet
UNUSUAL = FALSE | PRESENCE | lay.NOTICE_FLOOR | 3 * lay.NOTICE_STOOD


class Notices:
    """Attends to the notices of a walk."""

    def __init__(self, walk: WalkState, *, stood_first: bool) -> None:
        """``stood_first`` says that the walk begins with a stand that its start has used."""
        self._walk = walk
        self._standing_start = [stood_first] * 2

    def attend(self) -> Found:
        """Do what the newest epoch's notices ask for."""
        walk = self._walk
        notices = walk.space.n.item(lay.N_NOTICE)
        found = self._unusual(notices) if notices & UNUSUAL else []
        for foot in range(2):
            bits = notices >> (foot * lay.NOTICE_SHIFT)
            if bits & lay.STANCE_CONFIRMED:
                found += self._stance_confirmed(foot)
            elif bits & lay.STANCE_ENDED:
                found += self._stance_ended(foot)
        if notices & lay.NOTICE_WATCH and walk.coupled:
            found += walk.constrain("both", walk.method, walk.method.on_epoch(walk.gait))
        return found

    def _unusual(self, notices: int) -> Found:
        """Attend to what comes before a stance that starts or ends, if anything does."""
        walk = self._walk
        if notices & FALSE:
            walk.roll_back.clean_phases([notices & 15, notices >> lay.NOTICE_SHIFT])
        found = self._presence(notices) if notices & PRESENCE else []
        if notices & lay.NOTICE_FLOOR:
            found += self._floor()
        for foot in range(2):
            if notices & (lay.NOTICE_STOOD << foot):
                walk.stands.take(foot, walk.gait.stamp(walk.space.epoch))
        return found

    def _floor(self) -> Found:
        """Attend to what both standing feet have gained."""
        walk = self._walk
        if walk.watches_floor:
            return walk.carriage.window()
        walk.space.w[lay.F_SECONDS] = 0.0
        return []

    def _presence(self, notices: int) -> Found:
        """Attend to feet that are without samples, or that have samples again."""
        walk = self._walk
        found: Found = []
        stamp = walk.gait.stamp(walk.space.epoch)
        for foot in range(2):
            if notices & (lay.NOTICE_GONE << foot):
                standing = bool((notices >> (foot * lay.NOTICE_SHIFT)) & lay.STANCE_ENDED)
                found.append(walk.absences.gone(foot, stamp, standing=standing))
            elif notices & (lay.NOTICE_BACK << foot):
                # Before its first sample is used: that may be a ZUPT.
                walk.roll_back.before_newest(partial(walk.absences.back, foot, stamp))
            else:
                continue
            walk.carriage.interrupted()
            walk.forget()
            walk.watch()
            walk.heading_changed()
        return found

    def _phase(self, foot: int, last: int) -> StancePhase:
        walk = self._walk
        lag = lag_of(walk.space.n.item(lay.N_WINDOW))
        first = walk.space.foot(foot, "N_START")
        period, heading = walk.gait.period_s, walk.headings.mean
        return StancePhase(foot, first, last, lag, walk.space.epoch, period, heading)

    def _stance_confirmed(self, foot: int) -> Found:
        walk = self._walk
        space, gait = walk.space, walk.gait
        stamp, now = gait.stamp(space.foot(foot, "N_START")), gait.stamp(space.epoch)
        found = [Event(EventKind.STANCE_START, stamp, FEET[foot], now)]
        nis = walk.estimate.landing(foot, LANDING_STD)
        if nis > LOST_GATE or not walk.carriage.expects(nis):
            found += self._landed(foot, stamp, now)
        if walk.absences.of[foot] is Presence.BACK:
            walk.absences.level(foot)
            walk.forget()
        found += self._turn(foot, now)
        if walk.aids or walk.method.asks_at_start:
            found += self._ask_at_start(foot)
        return found

    def _ask_at_start(self, foot: int) -> Found:
        """Apply what the aids and the method ask for at the start of a stance of ``foot``."""
        walk = self._walk
        found: Found = []
        phase = self._phase(foot, walk.space.epoch)
        for method in self._askable(foot):
            if method.asks_at_start:
                requests = method.on_stance_start(phase, walk.gait)
                found += walk.constrain(FEET[foot], method, requests)
        return found

    def _landed(self, foot: int, stamp: int, now: int) -> Found:
        """Attend to a landing that may be none: the foot is lost, or on another floor."""
        walk = self._walk
        found: Found = []
        touchdown = walk.estimate.touchdown(foot, LANDING_STD)
        speed = lost_speed(touchdown)
        if speed is not None and not walk.gait.uneven:
            found += self._lost(foot, speed, stamp, now)
            touchdown = walk.estimate.touchdown(foot, LANDING_STD)  # it may be forgotten by now
        if walk.watches_floor:
            found += walk.carriage.landed(foot, touchdown, heading_known=walk.headings.known)
        return found

    def _lost(self, foot: int, speed: float, landed: int, now: int) -> Found:
        """Level and join a foot anew that has landed as none does: its samples were wrong."""
        walk = self._walk
        joined = walk.absences.of[foot] is Presence.JOINED
        if not (joined and walk.headings.known and walk.carriage.kind is None):
            return []
        ended = walk.gait.ended[foot]
        since = walk.gait.stamp(ended, landed)
        walk.absences.lost(foot, since, landed, speed)
        walk.carriage.interrupted()
        walk.watch()
        walk.heading_changed()
        return [Event(EventKind.LOST, since, FEET[foot], now)]

    def _turn(self, foot: int, now: int) -> Found:
        """Turn a foot, or both, when this stance tells where the walk heads."""
        walk = self._walk
        walking = walk.phase == "walking"
        if walk.headings.follows(foot):
            if walking:
                walk.headings.follow(foot)
                walk.headings_followed()
            return []
        turned = walk.headings.stance(walk.engine, foot, now, walking)
        walk.heading_changed()
        if turned and walk.headings.known:
            turned += walk.join_pair(now)
            walk.watch()
        return turned

    def _askable(self, foot: int) -> list[Method]:
        """Return the aids and the method, those that need the heading once it is known.

        The method needs both feet, and the aids the one that stands.
        """
        walk = self._walk
        known = walk.headings.known
        asked: list[Method] = []
        if walk.aids and walk.absences.of[foot] is Presence.JOINED:
            asked += [each for each in walk.aids if known or not each.needs_heading]
        if walk.absences.none and (known or not walk.method.needs_heading):
            asked.append(walk.method)
        return asked

    def _stance_ended(self, foot: int) -> Found:
        walk = self._walk
        gait = walk.gait
        last = walk.space.foot(foot, "N_LEAVE") - 1
        now = gait.stamp(walk.space.epoch)
        found = [Event(EventKind.STANCE_END, gait.stamp(last, now), FEET[foot], now)]
        walk.phase = "walking"
        gait.ended[foot] = last
        found += self._learn_bias(foot, now)
        done = walk.end_in_kernel(foot, now)
        if done is not None:
            return found + done
        if walk.aids or walk.method.asks_at_end:
            found += self._ask_at_end(foot, self._phase(foot, last))
        if walk.absences.can_join(foot):
            found += self._join(foot, self._phase(foot, last), now)
        return found

    def _ask_at_end(self, foot: int, phase: StancePhase) -> Found:
        """Apply what the aids and the method ask for at the end of a stance of ``foot``."""
        walk = self._walk
        found: Found = []
        for method in self._askable(foot):
            requests = method.on_stance_end(phase, walk.gait)
            found += walk.constrain(FEET[foot], method, requests)
        return found

    def _join(self, foot: int, phase: StancePhase, now: int) -> Found:
        """Put a foot that is back beside the other one, where that passed it."""
        walk = self._walk
        found: Found = []
        if walk.absences.of[1 - foot] is Presence.JOINED:
            moment = phase.moment(0.5)
            if not walk.gait.remembers(moment):
                return []
            spacing = walk.spacing[0] if walk.spacing else 0.0
            beside = partial(walk.absences.put_beside, foot=foot, spacing_m=spacing)
            doubted = (foot,) if walk.doubted else ()
            walk.roll_back.apply([Request(moment, True, beside)], doubted)
        found.append(walk.absences.joined(foot, now))
        walk.watch()
        walk.heading_changed()
        return found

    def _learn_bias(self, foot: int, now: int) -> Found:
        """Learn the gyro bias from the stand that has ended, unless it was that of the start."""
        walk = self._walk
        if self._standing_start[foot] or not walk.stands.stood(foot):
            self._standing_start[foot] = False
            walk.stands.forget(foot)
            return []
        return [_stood_event(foot, now, walk.stands.learn(foot, walk.estimate))]


def _stood_event(foot: int, now: int, outcome: Outcome) -> Event:
    return Event(EventKind.STOOD, now, FEET[foot], now, *outcome)
