"""Pairs in, updates out, one by one: refused, aligned with, or tracked."""

from __future__ import annotations

from collections import Counter

from numpy import empty

from .aids import AidInputs
from .alignment import Alignment, BiasPrior, Start
from .compiler import BackgroundEngine, compiled
from .config import TrackerConfig
from .errors import ConfigError
from .kernel import Engine, interpreted
from .kernel.layout import TAKEN, TO_ATTEND
from .results.context import Context
from .results.events import FEET, Event, EventKind
from .results.payloads import Reason
from .results.update import Update
from .samples.increments import Increments
from .samples.pair_gate import MAX_GAP_NS, Jump, PairGate
from .samples.series import FloatArray, ImuPair, IntArray
from .session import GivenPose, Session
from .session.session import TOLD


class PairStream:
    """The tracking of a stream of pairs, from its first alignment over every reset."""

    def __init__(
        self, config: TrackerConfig, counters: Counter[str], inputs: AidInputs, engine: str
    ) -> None:
        """Count in ``counters``; the aids use ``inputs``.

        Raises
        ------
        ConfigError
            For an unknown ``engine``.
        """
        self.config, self._counters, self._inputs = config, counters, inputs
        self.increments: dict[str, Increments | None] = dict.fromkeys(FEET)
        self.priors: dict[str, BiasPrior] = {}
        self._pose: GivenPose | None = None
        self.session: Session | None = None
        self._walking: Session | None = None  # when the next pair may just follow that before it
        self.use_engine(engine)
        self._begin()

    def _begin(self) -> None:
        self.align_anew()
        self.session = self._walking = None
        self._gate = PairGate()
        self._pending: list[Event] = []
        self._aids = self._inputs.methods()

    def align_anew(self) -> None:
        """Forget what an alignment has seen."""
        self.alignment = Alignment(self.config, self.priors)

    # --- the kernel ------------------------------------------------------------------------------

    def use_engine(self, engine: str) -> None:
        """Go on with another form of the kernel: "auto", "compiled" or "interpreted".

        Raises
        ------
        ConfigError
            For any other ``engine``.
        """
        if engine not in ("auto", "compiled", "interpreted"):
            raise ConfigError(
                f"engine is {engine!r}; allowed is one of auto, compiled, interpreted"
            )
        self._walking = None
        self.background = BackgroundEngine() if engine == "auto" else None
        self.engine = compiled() if engine == "compiled" else interpreted()
        if self.session is not None:
            self.session.use(self.engine)

    def use(self, engine: Engine) -> None:
        """Go on with ``engine`` for good."""
        self.engine, self.background = engine, None
        if self.session is not None:
            self.session.use(engine)

    def wait_for_engine(self) -> None:
        """Go on with the compiled kernel, where one was asked for and can be had."""
        if self.background is not None:
            engine = self.background.wait()
            self.use(engine if engine is not None else self.engine)

    def _poll_engine(self) -> None:
        ready = self.background.poll() if self.background else None
        if ready is not None:
            self.use(ready)

    # --- pairs -----------------------------------------------------------------------------------

    @property
    def phase(self) -> str:
        """The phase: "aligning", "standing" (aligned, still refining) or "walking"."""
        return self.session.phase if self.session else "aligning"

    @property
    def undisturbed(self) -> Session | None:
        """The session, when nothing but samples can change it now."""
        return None if self._pose or self._pending else self.session

    @property
    def counters(self) -> Counter[str]:
        """What became of the pairs, by name."""
        self._note_taken()
        return self._counters

    @property
    def gate(self) -> PairGate:
        """What decides about each pair."""
        self._note_taken()
        return self._gate

    def _note_taken(self) -> None:
        """Take note of the pairs that the kernel has taken by itself."""
        if self.session is not None:
            taken, newest_ns = self.session.pairs_taken()
            if taken:
                self._counters["pairs"] += taken
                self._gate.went_on(newest_ns)

    def set_pose(self, pose: GivenPose) -> None:
        """Put the person where the ``pose`` says, with the next pair that is tracked."""
        self._pose, self._walking = pose, None

    def reset(self, stamp_ns: int, reason: Reason) -> None:
        """Forget everything but the counters and align anew."""
        self.counters["resets"] += 1
        self._begin()
        self._pending.append(Event(EventKind.RESET, stamp_ns, "both", stamp_ns, reason=reason))

    def retune(self, config: TrackerConfig) -> None:
        """Go on with the weights, thresholds, aids and distances of ``config``."""
        self.config = config
        self._aids = self._inputs.retune(config.aids, self._aids)
        if self.session is not None:
            self.session.retune(config, self._aids)

    def add(self, pair: ImuPair) -> Update:
        """Take one pair; total: bad data gives a counted, named refusal, never an exception."""
        stamp, session = int(pair.stamp_ns), self._walking
        if session is not None:
            told = empty(TOLD)
            done = session.take(stamp, pair.values, told)
            if done == TAKEN:  # nearly always
                return Update(stamp, session.context, told)
            if done == TO_ATTEND:
                update = session.attend(stamp, told)
                return self._not_finite(stamp) if update is None else update
        return self._add(stamp, pair.values)

    def _add(self, stamp: int, values: FloatArray) -> Update:
        """Take a pair of which nothing is known, and see whether the next may just follow it."""
        gate, counters = self.gate, self.counters
        refused = gate.refusal(stamp, values)
        if refused is Jump.BEGINS_ANEW:
            self.reset(stamp, Reason.TIME_JUMPED)
        elif refused is not None and refused is not Jump.CLOCK_SET:
            counters[refused] += 1
            return self._without(stamp, self.phase, refused)
        counters["pairs"] += 1
        if self.background is not None:
            self._poll_engine()
        update = self._take(stamp, values, jumped=refused is Jump.CLOCK_SET)
        session = self.undisturbed if self.background is None else None
        self._walking = session if session and session.phase == "walking" else None
        return update

    def _take(self, stamp: int, values: FloatArray, *, jumped: bool) -> Update:
        """Take a pair that is not refused; ``jumped`` says that a clock was set before it."""
        dt_ns = self.gate.step(stamp)
        if self.session is None:
            if jumped:
                self.align_anew()
            return self._align(stamp, values)
        if jumped:
            self.counters["clock_jumps"] += 1
            dt_ns = 2 * self.session.holes.period_ns
        return self._track(self.session, stamp, dt_ns, values)

    def _without(self, stamp: int, phase: str, refused: str | None = None) -> Update:
        """Return an update without an estimate."""
        return Update(stamp, Context(phase, events=self._take_pending(), refused=refused))

    def _take_pending(self) -> tuple[Event, ...]:
        events, self._pending = tuple(self._pending), []
        return events

    def _align(self, stamp: int, values: FloatArray) -> Update:
        """Look for a start."""
        return self._started(stamp, self.alignment.add(stamp, values))

    def align_all(self, stamps: IntArray, values: FloatArray) -> tuple[int, Update | None]:
        """Take the first pairs (N, 12) as `add` does, as far as they can be taken many at once.

        That is while nothing but windows matters.  Return how many were taken, and the update of
        the last one when that has started a track.
        """
        if self.session is not None or self._pending or not self.alignment.takes_many:
            return 0, None
        count = self.gate.plain(stamps, values)
        taken, start = self.alignment.add_all(stamps[:count], values[:count])
        if taken == 0:
            return 0, None
        last_ns = int(stamps[taken - 1])
        self.counters["pairs"] += taken
        self.gate.went_on(last_ns)
        update = self._started(last_ns, start)
        return taken, None if start is None else update

    def _started(self, stamp: int, start: Start | None) -> Update:
        """Begin with a start, if there is one; where pairs have waited for it, run them first."""
        self.counters["alignment_restarts"] = self.alignment.restarts
        if start is None:
            return self._without(stamp, "aligning")
        session = self._begin_session(start, stamp)
        if not start.waiting:
            return self._without(stamp, "aligning")
        return self._catch_up(session, start)

    def _begin_session(self, start: Start, stamp: int) -> Session:
        kinds = [self.increments[foot] for foot in FEET]
        refining = None if start.waiting else self.alignment
        session = Session(self.config, self.engine, start, refining, self._aids, kinds)
        self.session = session
        self._pending.append(session.aligned_event(stamp))
        return session

    def _catch_up(self, session: Session, start: Start) -> Update:
        """Run the pairs that have waited; return the update of the newest, with those before."""
        before: list[Update] = []
        last_ns = max(foot.end_ns for foot in start.feet)
        for stamp, values in start.waiting:
            before.append(self._track(session, stamp, stamp - last_ns, values))
            last_ns = stamp
        return before[-1].after(before[:-1])

    def start_late(self, stamp_ns: int) -> Update | None:
        """Start from what is there when no pair follows that of ``stamp_ns``."""
        start = self.alignment.finish() if self.session is None else None
        if start is None or not start.waiting:
            return None
        return self._catch_up(self._begin_session(start, stamp_ns), start)

    def _track(self, session: Session, stamp: int, dt_ns: int, values: FloatArray) -> Update:
        before: tuple[Event, ...] = ()
        holes = session.holes
        if self._pending:
            before = self._take_pending()
        if dt_ns > MAX_GAP_NS:
            self.counters["gaps"] += 1
            before = (*before, *holes.bridge(dt_ns * 1e-9))
            dt_ns = holes.period_ns
        elif dt_ns > holes.longest_ns:
            self.counters["filled"] += 1
            before = (*before, *holes.fill(stamp, dt_ns, values))
            dt_ns = holes.filled_ns
        if self._pose is not None:
            before = (*before, *self._apply_pose(session, stamp))
        update = session.step(stamp, dt_ns * 1e-9, values, before)
        return self._not_finite(stamp) if update is None else update

    def _not_finite(self, stamp: int) -> Update:
        """Begin anew after an epoch that was no numbers: the last guard."""
        self.reset(stamp, Reason.NOT_FINITE)
        return self._without(stamp, "aligning")

    def _apply_pose(self, session: Session, stamp: int) -> list[Event]:
        if self._pose is None or not session.can_set_pose():
            return []
        pose, self._pose = self._pose, None
        return session.set_pose(stamp, pose)

    def went_on(self, count: int, last_ns: int, *, numbers: bool) -> None:
        """Take note that ``undisturbed`` has run pairs up to that of ``last_ns``.

        When what they gave is no ``numbers``, begin anew.
        """
        self.counters["pairs"] += count
        self.gate.went_on(last_ns)
        if not numbers:
            self.reset(last_ns, Reason.NOT_FINITE)
