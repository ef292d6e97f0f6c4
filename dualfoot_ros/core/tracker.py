"""The facade: synchronised pairs in, both feet's estimates and events out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from .aids import AidInputs
from .alignment import Alignment, BiasPrior, Start
from .compiler import BackgroundEngine, compiled
from .config import TrackerConfig
from .errors import AlignmentError, ConfigError, SnapshotError
from .given_pose import GivenPose, given_pose
from .kernel import Engine, interpreted
from .kernel import layout as lay
from .results.events import FEET, Event, EventKind
from .results.payloads import Reason
from .results.rows import to_trajectory, turn_rows
from .results.trajectory import Trajectory
from .results.update import Update
from .samples.increments import Increments
from .samples.pair_gate import MAX_GAP_NS, Jump, PairGate, next_irregular, regular_samples
from .samples.series import (
    BoolArray,
    FieldSeries,
    FloatArray,
    ImuPair,
    ImuSeries,
    IntArray,
    PressureSeries,
    stack_pairs,
)
from .session import Session
from .snapshot import dump, restore


class DualFootTracker:
    """Tracks both feet of a walking person from synchronised pairs of samples.

    ``engine`` is "auto" (live starts interpreted and goes over to the compiled kernel when it is
    ready), "compiled" or "interpreted"; all three give the same bits.

    Raises
    ------
    ConfigError
        For an unknown ``engine``.
    """

    def __init__(self, config: TrackerConfig | None = None, *, engine: str = "auto") -> None:
        """Start aligning with the first pair."""
        self.config = config or TrackerConfig()
        self.counters: Counter[str] = Counter()
        self._session: Session | None = None
        self.use_engine(engine)
        self._pose: GivenPose | None = None
        self._inputs = AidInputs(self.config.aids, self.counters)
        self._increments: dict[str, Increments | None] = dict.fromkeys(FEET)
        self._priors: dict[str, BiasPrior] = {}
        self._begin()

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
        self._background = BackgroundEngine() if engine == "auto" else None
        self._engine = compiled() if engine == "compiled" else interpreted()
        if self._session is not None:
            self._session.use(self._engine)

    def save(self) -> bytes:
        """Return a snapshot of all that the tracker is, to go on from it by `load`."""
        return dump(self, self.config.to_mapping())

    @classmethod
    def load(cls, snapshot: bytes, *, engine: str = "auto") -> DualFootTracker:
        """Return the tracker of a ``snapshot``; it goes on as that one would have, bit for bit.

        Raises
        ------
        SnapshotError
            When the snapshot is damaged, or of another version.
        ConfigError
            For an unknown ``engine``.
        """
        tracker = restore(snapshot)
        if not isinstance(tracker, cls):
            raise SnapshotError("the snapshot is not that of a tracker")
        tracker.use_engine(engine)
        return tracker

    def _begin(self) -> None:
        self._alignment = Alignment(self.config, self._priors)
        self._session = None
        self._gate = PairGate()
        self._pending: list[Event] = []
        self._aids = self._inputs.methods()

    @property
    def engine(self) -> str:
        """Which form of the kernel runs: "interpreted" or "compiled"."""
        return self._engine.name

    @property
    def phase(self) -> str:
        """The phase: "aligning", "standing" (aligned, still refining) or "walking"."""
        return self._session.phase if self._session else "aligning"

    @property
    def spacing(self) -> tuple[float, float] | None:
        """Distance of the feet side by side, given or learnt, and its standard deviation, m."""
        return self._session.spacing if self._session else None

    @property
    def complaint(self) -> str | None:
        """Why the last window of the alignment was no standstill, if it was not."""
        return self._alignment.complaint

    def reset(self, stamp_ns: int | None = None, reason: Reason = Reason.ASKED_FOR) -> None:
        """Forget everything but the counters and align anew."""
        self.counters["resets"] += 1
        self._begin()
        stamp = 0 if stamp_ns is None else stamp_ns
        self._pending.append(Event(EventKind.RESET, stamp, "both", stamp, reason=reason))

    def retune(self, config: TrackerConfig) -> None:
        """Go on with the weights, thresholds, aids and distances of ``config``.

        What else it changes holds from the next alignment on; the method must be the same.

        Raises
        ------
        ConfigError
            When the method is another one.
        """
        if config.method != self.config.method:
            raise ConfigError(
                f"method is {config.method}; a running tracker keeps to {self.config.method}"
            )
        self.config = config
        self._aids = self._inputs.retune(config.aids, self._aids)
        if self._session is not None:
            self._session.retune(config, self._aids)

    def set_pose(
        self, position: Sequence[float], yaw: float, covariance: FloatArray | None = None
    ) -> None:
        """Move and turn both tracks so that the person is at ``position`` (3,) m facing ``yaw``.

        ``covariance`` (4, 4) of x, y, z (m) and yaw (rad) says how well that is known; without it
        the tracks keep theirs.  Takes effect with the next pair that is tracked.

        Raises
        ------
        ConfigError
            When ``position`` is not three finite numbers, ``yaw`` is not finite, or ``covariance``
            is none.
        """
        self._pose = given_pose(position, yaw, covariance)

    def add(self, pair: ImuPair) -> Update:
        """Take one pair; total: bad data gives a counted, named refusal, never an exception."""
        stamp, values = int(pair.stamp_ns), pair.values
        refused = self._gate.refusal(stamp, values)
        jumped = refused is Jump.CLOCK_SET
        if refused is Jump.BEGINS_ANEW:
            self.reset(stamp, Reason.TIME_JUMPED)
        elif refused is not None and not jumped:
            self.counters[refused] += 1
            return Update(stamp, self.phase, refused=refused, events=self._take_pending())
        self.counters["pairs"] += 1
        if self._background is not None:
            self._poll_engine()
        dt_ns = self._gate.step(stamp)
        if self._session is None:
            if jumped:
                self._alignment = Alignment(self.config, self._priors)
            return self._align(stamp, values)
        if jumped:
            self.counters["clock_jumps"] += 1
            dt_ns = 2 * self._session.period_ns
        return self._track(self._session, stamp, dt_ns, values)

    def declare_increments(self, foot: str, kind: Increments | None) -> None:
        """Take note what the samples of "left" or "right" are, as their source says.

        It holds from the next alignment on; ``increments`` in the configuration wins over it.
        """
        self._increments[foot] = kind

    def declare_bias(self, foot: str, prior: BiasPrior | None) -> None:
        """Take what is known of the gyro bias of "left" or "right" before the walk.

        It holds from the next alignment on.
        """
        self._priors.pop(foot, None)
        if prior is not None:
            self._priors[foot] = prior
        if self._session is None:
            self._alignment = Alignment(self.config, self._priors)

    def add_pressure(self, worn: str, stamp_ns: int, pascal: float) -> str | None:
        """Take air pressure (Pa) of a sensor worn on "left" or "right", or on the body for "both".

        It is used when ``aids.barometer`` is on; the stamp is of the clock of the pairs.  Returns
        the name of why it was refused, if it was; all is counted.

        Raises
        ------
        ConfigError
            When ``worn`` is none of these.
        """
        refused = self._inputs.take_pressure(worn, int(stamp_ns), float(pascal))
        self._inputs.trim()
        return refused

    def add_magnetic_field(
        self, foot: str, stamp_ns: int, tesla: Sequence[float] | FloatArray
    ) -> str | None:
        """Take the field (3,) T in the axes of the sensor on "left" or "right", forward-left-up.

        It is used when ``aids.magnetic_heading`` is on; the stamp is of the clock of the pairs.
        Returns the name of why it was refused, if it was; all is counted.

        Raises
        ------
        ConfigError
            When ``foot`` is none of these, or ``tesla`` are not three numbers.
        """
        refused = self._inputs.take_field(foot, int(stamp_ns), tesla)
        self._inputs.trim()
        return refused

    def _poll_engine(self) -> None:
        ready = self._background.poll() if self._background else None
        if ready is not None:
            self._use(ready)

    def _use(self, engine: Engine) -> None:
        self._engine, self._background = engine, None
        if self._session is not None:
            self._session.use(engine)

    def _take_pending(self) -> tuple[Event, ...]:
        events, self._pending = tuple(self._pending), []
        return events

    def _align(self, stamp: int, values: FloatArray) -> Update:
        """Look for a start; where pairs have waited for it, run them first."""
        start = self._alignment.add(stamp, values)
        self.counters["alignment_restarts"] = self._alignment.restarts
        if start is None:
            return Update(stamp, "aligning", events=self._take_pending())
        session = self._begin_session(start)
        self._pending.append(session.aligned_event(stamp))
        if not start.waiting:
            return Update(stamp, "aligning", events=self._take_pending())
        return self._catch_up(session, start)

    def _begin_session(self, start: Start) -> Session:
        kinds = [self._increments[foot] for foot in FEET]
        refining = None if start.waiting else self._alignment
        session = Session(self.config, self._engine, start, refining, self._aids, kinds)
        self._session = session
        return session

    def _catch_up(self, session: Session, start: Start) -> Update:
        """Run the pairs that have waited; return the update of the newest, with those before."""
        before: list[Update] = []
        last_ns = max(foot.end_ns for foot in start.feet)
        for stamp, values in start.waiting:
            before.append(self._track(session, stamp, stamp - last_ns, values))
            last_ns = stamp
        return before[-1].after(before[:-1])

    def _track(self, session: Session, stamp: int, dt_ns: int, values: FloatArray) -> Update:
        before: tuple[Event, ...] = ()
        if self._pending:
            before = self._take_pending()
        if dt_ns > MAX_GAP_NS:
            self.counters["gaps"] += 1
            before = (*before, *session.bridge(dt_ns * 1e-9))
            dt_ns = session.period_ns
        elif dt_ns > session.longest_ns:
            self.counters["filled"] += 1
            before = (*before, *session.fill(stamp, dt_ns, values))
            dt_ns = session.filled_ns
        if self._pose is not None:
            before = (*before, *self._apply_pose(session, stamp))
        row, found = session.step(stamp, dt_ns * 1e-9, values)
        if not np.isfinite(row).all():  # the last guard: nothing that is no number ever leaves
            self.reset(stamp, Reason.NOT_FINITE)
            return Update(stamp, "aligning", events=self._take_pending())
        return Update(
            stamp,
            session.phase,
            row=row,
            events=(*before, *found) if found else before,
            blocks=session.space.blocks(),
            facing=session.facing,
        )

    def _apply_pose(self, session: Session, stamp: int) -> list[Event]:
        if self._pose is None or not session.can_set_pose():
            return []
        pose, self._pose = self._pose, None
        return session.set_pose(stamp, pose)

    def run(
        self,
        left: ImuSeries,
        right: ImuSeries,
        pressure: Mapping[str, PressureSeries] | None = None,
        fields: Mapping[str, FieldSeries] | None = None,
    ) -> Trajectory:
        """Track two series with equal stamps; the same bits as `add`, one by one.

        ``pressure`` is air pressure by "left", "right" or "both", for the barometer aid;
        ``fields`` the magnetic field by "left" or "right" as it was measured, for the magnetic
        heading (default: that of the series).

        Raises
        ------
        SeriesError
            When the series do not have the same stamps.
        AlignmentError
            When there is no standstill to align from.
        ConfigError
            When ``pressure`` or ``fields`` has another key.
        """
        values = stack_pairs(left, right)
        for foot, imu in zip(FEET, (left, right), strict=True):
            if imu.increments is not None:
                self.declare_increments(foot, imu.increments)
        if self._background is not None:
            engine = self._background.wait()
            self._use(engine if engine is not None else self._engine)
        for worn, series in (pressure or {}).items():
            for stamp, pascal in zip(series.stamp_ns, series.pressure, strict=True):
                self._inputs.take_pressure(worn, int(stamp), float(pascal))
        for foot, field in (fields_of(left, right) if fields is None else fields).items():
            self._inputs.take_fields(foot, field)
        stamps, rows, events = self._run(left.stamp_ns, values)
        if not len(stamps):
            raise AlignmentError(self._no_start(left))
        return to_trajectory(stamps, rows, tuple(events), self.counters, self.config.method)

    def _no_start(self, left: ImuSeries) -> str:
        if self._alignment.finish() is not None:
            return f"the recording is {left.duration_s:.1f} s long and ends while the feet stand"
        seen = self.complaint or f"the recording is {left.duration_s:.1f} s long"
        return (
            f"neither a standstill of both feet nor a stance of each was found ({seen}); stand "
            "still with both feet on the ground at the start, and check units and axes"
        )

    def _go_on(self, rows: FloatArray, last_ns: int) -> bool:
        """Take note that samples have been run; return whether their rows (N, OUT) are numbers."""
        self.counters["pairs"] += len(rows)
        self._gate.step(last_ns)
        finite = bool(np.isfinite(rows).all())
        if not finite:
            self.reset(last_ns, Reason.NOT_FINITE)
        return finite

    def _start_late(self, stamp_ns: int) -> Update | None:
        """Start from what is there when no pair follows that of ``stamp_ns``."""
        start = self._alignment.finish() if self._session is None else None
        if start is None or not start.waiting:
            return None
        session = self._begin_session(start)
        self._pending.append(session.aligned_event(stamp_ns))
        return self._catch_up(session, start)

    def _run(
        self, stamps: IntArray, values: FloatArray
    ) -> tuple[IntArray, FloatArray, list[Event]]:
        """Feed everything; long regular stretches of walking go through the kernel at once."""
        count = len(stamps)
        out = np.zeros((count, lay.OUT))
        kept = np.zeros(count, dtype=bool)
        dts = np.diff(stamps, prepend=stamps[:1]) * 1e-9
        stops: IntArray | None = None
        events: list[Event] = []
        taken: list[int] = []
        k = 0
        while k < count:
            session = self._session if self.phase == "walking" and not self._pose else None
            if session is not None and stops is None:
                stops = next_irregular(regular_samples(stamps, values, session.longest_ns))
            if session is not None and stops is not None and (stop := int(stops[k])) > k:
                for row, found in session.steps(stamps, dts, values, (k, stop), out):
                    _note(out, row, found, events)
                kept[k:stop] = self._go_on(out[k:stop], int(stamps[stop - 1]))
                k = stop
                continue
            update = self.add(ImuPair(int(stamps[k]), values[k]))
            if update.refused is None:
                taken.append(k)
            if any(event.kind is EventKind.RESET for event in update.announced):
                stops = None
                kept[:k], taken = False, taken[-1:]
                events.clear()
            _keep(update, taken, out, kept, events)
            k += 1
        if taken and (late := self._start_late(int(stamps[taken[-1]]))) is not None:
            _keep(late, taken, out, kept, events)
        return *_only(kept, stamps, out), events


def fields_of(left: ImuSeries, right: ImuSeries) -> dict[str, FieldSeries]:
    """Return the magnetic field of the feet that have one."""
    found = zip(FEET, (left.field, right.field), strict=True)
    return {foot: field for foot, field in found if field is not None and len(field)}


def _only(kept: BoolArray, stamps: IntArray, out: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return the rows that are kept, without a copy where they are all from some row on."""
    first = int(np.argmax(kept)) if kept.any() else len(kept)
    if kept[first:].all():
        return stamps[first:], out[first:]
    return stamps[kept], out[kept]


def _keep(
    update: Update,
    taken: Sequence[int],
    out: FloatArray,
    kept: BoolArray,
    events: list[Event],
) -> None:
    """Keep an update, and those before it, in the rows of the pairs ``taken`` last."""
    updates = (*update.earlier, update)
    for each, row in zip(updates, taken[-len(updates) :], strict=False):
        if each.row is not None:
            out[row], kept[row] = each.row, True
        _note(out, row, each.announced, events)


def _note(out: FloatArray, row: int, found: Sequence[Event], events: list[Event]) -> None:
    """Keep the events of a row; a heading turns the rows before it."""
    for event in found:
        if event.kind is EventKind.HEADING:
            turn_rows(out[:row], event)
    events.extend(found)
