"""A tracker that has been aligned: it runs epochs and attends to what they report."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..alignment import Alignment, Start
from ..config import TrackerConfig
from ..constraints import Method
from ..kernel import Engine
from ..kernel import layout as lay
from ..results.context import Context
from ..results.events import FEET, Event, EventKind
from ..results.facing import Facing
from ..results.payloads import Levelled
from ..results.row_store import RowStore
from ..results.update import Update
from ..samples.increments import Increments
from ..samples.pair_series import PairSeries
from ..samples.series import FloatArray
from .given_pose import GivenPose, apply_covariance
from .holes import Holes
from .notices import Found, Notices
from .walk_state import WalkState

TOLD = (1, lay.TOLD)  # shape of what is told of one epoch


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
        self._start, self._alignment, self._feet = start, alignment, start.feet
        self._origin = np.zeros(3)
        self._pose_covariance: FloatArray | None = None
        self._walk = walk = WalkState(config, start.rate_hz, aids, increments)
        self._notices = Notices(walk, stood_first=not start.waiting)
        self.holes = Holes(walk, self.step)
        self.space, self.rate_hz = walk.space, start.rate_hz
        self._w, self._n, self._stamps = walk.space.w, walk.space.n, walk.space.stamps
        self.context = Context(walk.phase)
        self.use(engine)
        self._level()
        for foot, still in enumerate(start.feet):
            if still.absent:
                walk.absences.never_there(foot, still.end_ns)
        walk.heading_changed()

    @property
    def phase(self) -> str:
        """The phase: "standing" (the stand of the start goes on) or "walking"."""
        return self._walk.phase

    @property
    def facing(self) -> Facing:
        """Where the feet head in their axes, as far as that is known."""
        return self._walk.facing

    @property
    def spacing(self) -> tuple[float, float] | None:
        """Distance of the feet side by side and its standard deviation, m, if it is in use."""
        return self._walk.spacing

    def retune(self, config: TrackerConfig, aids: Sequence[Method]) -> None:
        """Go on with other weights, thresholds, aids and distances."""
        self._walk.retune(config, aids)

    def use(self, engine: Engine) -> None:
        """Go on with another form of the kernel."""
        self._engine = engine
        self._walk.use(engine)

    def pairs_taken(self) -> tuple[int, int]:
        """Return how many pairs `take` has taken since this was asked, and the newest stamp."""
        taken, self._n[lay.N_PAIRS] = self._n.item(lay.N_PAIRS), 0
        return taken, self._stamps.item(self._n.item(lay.N_EPOCH) % len(self._stamps))

    def _level(self) -> None:
        walk = self._walk
        walk.initial.level(self._feet, self._origin, walk.headings.forward)
        arm = walk.method.lever_arm
        if arm is not None:
            walk.estimate.place(1, walk.second_sensor(arm))
        if self._pose_covariance is not None:
            apply_covariance(self.space, self._pose_covariance, replace=False)
        walk.headings.levelled()
        walk.heading_changed()
        walk.watch()

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

    def step(
        self, stamp: int, dt_s: float, values: FloatArray, before: tuple[Event, ...] = ()
    ) -> Update | None:
        """Run one epoch; return its update, with the events ``before`` it.

        None when it is no numbers: nothing of that may leave.
        """
        if self._walk.phase == "standing":
            self._refine(stamp, values)
        sample, told = np.empty(12), np.empty(TOLD)
        sample[...] = values
        if self._engine.step(self._w, self._n, self._stamps, stamp, dt_s, sample, told):
            return self._update(stamp, told, before)
        return self.attend(stamp, told, before)

    def take(self, stamp: int, values: FloatArray, told: FloatArray) -> int:
        """Let the kernel take a pair of a walk by itself; return what `take_pair` returns.

        An update of it has ``context`` and ``told`` (1, TOLD).
        """
        done: int = self._engine.take_pair(self._w, self._n, self._stamps, stamp, values, told)
        return done

    def attend(
        self, stamp: int, told: FloatArray, before: tuple[Event, ...] = ()
    ) -> Update | None:
        """Attend to what the newest epoch has reported; return as `step` does."""
        w, n, engine = self._w, self._n, self._engine
        if n[lay.N_NOTICE]:
            before = (*before, *self._notices.attend())
            engine.emit(w, n, told, 0)
        if not engine.tell(w, told):
            return None
        return self._update(stamp, told, before)

    def _update(self, stamp: int, told: FloatArray, events: tuple[Event, ...]) -> Update:
        """Return the update of an epoch after which anything may be otherwise than before."""
        phase, facing = self._walk.phase, self._walk.facing
        if self.context.phase != phase or self.context.facing is not facing:
            self.context = Context(phase, facing)
        return Update(stamp, Context(phase, facing, events) if events else self.context, told)

    def _refine(self, stamp: int, values: FloatArray) -> None:
        """Level anew when the stand has gone on for a window's length more."""
        alignment = self._alignment
        if alignment is None or not math.isfinite(values.sum()):
            self._alignment = None
        elif alignment.refine(stamp, values):
            self._feet = alignment.result()
            self._level()

    def steps(
        self, series: PairSeries, span: tuple[int, int], rows: RowStore
    ) -> Iterator[tuple[int, Found]]:
        """Run the pairs of ``span`` [start, stop), each of which follows the one before it.

        What is kept of them goes to their ``rows``; those that brought events are yielded.
        """
        for part in self._levelled_spans(series, span):
            yield from self._epochs(series, part, rows.arrays)

    def _levelled_spans(
        self, series: PairSeries, span: tuple[int, int]
    ) -> Iterator[tuple[int, int]]:
        """Yield the parts of ``span`` that are run with one level; between them level a stand."""
        first, stop = span
        alignment = self._alignment if self.phase == "standing" else None
        if alignment is not None:
            values = series.values(slice(*span))
            missing = np.isnan(values).any(axis=1)
            known = int(np.append(missing, True).argmax())
            for row in alignment.refine_all(
                series.stamp_ns[first : first + known], values[:known]
            ):
                yield first, span[0] + row
                first = span[0] + row
                if self.phase != "standing":
                    break
                self._feet = alignment.result()
                self._level()
            if span[0] + known < stop:
                self._alignment = None
        yield first, stop

    def _epochs(
        self, series: PairSeries, span: tuple[int, int], kept: tuple[Any, ...]
    ) -> Iterator[tuple[int, Found]]:
        """Run the epochs of ``span`` as they are; yield as `steps` does."""
        given = self._stamps, series.stamp_ns, *series.arrays
        w, n, (k, stop) = self._w, self._n, span
        while k < stop:
            k = self._engine.advance(w, n, *given, k, stop, *kept)
            if n[lay.N_NOTICE]:
                found = self._notices.attend()
                self._engine.keep(w, n, k - 1, *kept)
                if found:
                    yield k - 1, found

    def heading_variances(self) -> list[float]:
        """Return the variance of the heading of each foot that is there, rad^2."""
        own = [self.space.own_block(foot).item(lay.E_ATT + 2, lay.E_ATT + 2) for foot in range(2)]
        there = [not self._n[lay.N_FOOT + f * lay.N_STRIDE + lay.N_GONE] for f in range(2)]
        return [each for each, is_there in zip(own, there, strict=True) if is_there]

    def can_set_pose(self) -> bool:
        """Return whether `set_pose` can be obeyed now: standing, or the heading is known."""
        return self.phase == "standing" or self._walk.headings.known

    def set_pose(self, stamp: int, pose: GivenPose) -> Found:
        """Put the person where the ``pose`` says; return both tracks' turns."""
        walk = self._walk
        found: Found = []
        if self.phase == "standing":
            up_m = float(pose.position[2] - self._origin[2])
            turned = pose.yaw - walk.headings.forward
            self._origin, self._pose_covariance = pose.position, pose.covariance
            walk.headings.face(pose.yaw)
            self._level()
        else:
            found = walk.headings.set_pose(walk.engine, pose.position, pose.yaw, stamp)
            if pose.covariance is not None:
                apply_covariance(self.space, pose.covariance, replace=True)
            walk.heading_changed()
            up_m, turned = found[0].turn.shift[2], found[0].turn.yaw
        for method in (*walk.aids, walk.method):
            method.moved(up_m, turned)
        walk.forget()
        return found
