"""Going back, correcting and running again equals having done right at once, to the bit."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.core.constraints.idc import Idc, IdcConfig
from dualfoot_ros.core.constraints.method import Request
from dualfoot_ros.core.joint_estimate import Outcome
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.payloads import Reason
from dualfoot_ros.core.session import notices
from dualfoot_ros.core.session.walk_state import WalkState

from .harness import Pairs, follow, open_session, quick_engine, standing_samples, state_bits, walk

# a constraint to a distance that the feet do not have looks like a floor that moves
AS_IS = {"heading.source": "sensor", "floor.watch": False}


class Late(Idc):
    """Asks for idc's correction at a moment so many epochs before the end of each stance."""

    def __init__(self, config: IdcConfig, back: Sequence[int]) -> None:
        super().__init__(config)
        self.memory_s = 1.5
        self.asked: list[Request] = []
        self._back = back

    def on_stance_end(self, stance, gait):
        moment = gait.now - 1 - self._back[len(self.asked) % len(self._back)]
        if not gait.remembers(moment):
            return ()
        self.asked.append(Request(moment, True, self.apply))
        return (self.asked[-1],)


def session_with(method: Idc, pairs: Pairs):
    """Return a session of the base filter that asks ``method``, and its first sample."""
    config = TrackerConfig.from_mapping({"method": "idc", "idc.kappa": 0.0, **AS_IS})
    session, start = open_session(config, pairs)
    session._walk.method = method
    return session, start


@pytest.mark.parametrize(
    "back",
    [(0,), (20,), (45,), (5, 60), (60, 5), (30, 31, 1, 70)],
    ids=lambda back: "-".join(map(str, back)),
)
@pytest.mark.parametrize("std", (0.0, 0.1))
def test_a_constraint_at_an_earlier_moment_equals_having_applied_it_then(back, std, monkeypatch):
    """With moments 60 and 5 epochs back in turn, one constraint falls between another's two.

    A distance that is never true lets feet land as none do; that they are lost then is no part of
    this, as it is decided once, with what was known.
    """
    monkeypatch.setattr(notices, "lost_speed", lambda *_: None)
    pairs = walk(20.0)
    method = Late(IdcConfig(distance=0.05, distance_std=std), back)
    session, start = session_with(method, pairs)
    events = [e for _, es in follow(session, pairs, start) for e in es]
    accepted = [e for e in events if e.kind is EventKind.CONSTRAINT and e.accepted]
    assert len(accepted) > 10
    if len(back) > 1:
        moments = [request.epoch for request in method.asked]
        assert moments != sorted(moments)

    again, start = session_with(Late(method.config, (10**6,)), pairs)
    due: dict[int, int] = {}
    for event in accepted:
        epoch = int(np.searchsorted(pairs.stamps, event.stamp_ns)) - start
        due[epoch] = due.get(epoch, 0) + 1
    for epoch, _ in follow(again, pairs, start):
        for _ in range(due.get(epoch, 0)):
            again._walk.roll_back.apply([Request(epoch, False, method.apply)], (0, 1))
    assert state_bits(again.space.w) == state_bits(session.space.w)


class Refusing(Late):
    """Rolls back each time, and then finds nothing to apply."""

    def apply(self, estimate, target=None, heading=0.0, separation=None):
        return Outcome(np.zeros(1), np.ones((1, 1)), 0.0, accepted=False)


def test_a_refused_constraint_leaves_the_state_as_it_was_to_the_bit():
    pairs = walk(15.0)
    session, start = session_with(Refusing(IdcConfig(), (30,)), pairs)
    events = [e for _, es in follow(session, pairs, start) for e in es]
    assert sum(e.kind is EventKind.CONSTRAINT for e in events) > 10
    plain, start = open_session(TrackerConfig.from_mapping({"method": "zupt", **AS_IS}), pairs)
    for _ in follow(plain, pairs, start):
        pass
    assert state_bits(session.space.w) == state_bits(plain.space.w)


# --- gait phases -------------------------------------------------------------------------------

RATE = 50.0
PHASES = {
    "stance.detector": "fixed",
    "stance.min_stance": 0.1,
    "stance.min_swing": 0.16,
    "stance.window": 0.04,
}
MIN_STANCE, MIN_SWING, WINDOW = 5, 8, 2
MEMORY = {"method": "idc", "idc.kappa": 0.0, "idc.max_stance": 3.0, **AS_IS, **PHASES}


def stillness(runs: list[int]) -> np.ndarray:
    """Return still/moving in turn, with the given lengths, starting still."""
    return np.concatenate([np.full(n, k % 2 == 0) for k, n in enumerate(runs)])


def shaken(still: np.ndarray, foot: int, lead: int) -> Pairs:
    """Return pairs in which ``foot`` turns about z whenever it is not still, after ``lead``."""
    pairs = standing_samples(lead + len(still), RATE)
    pairs.values[lead:, 6 * foot + 5] += np.where(still, 0.0, 3.0)
    return pairs


def cleaned(still: np.ndarray) -> np.ndarray:
    """Return the stance phases: first too short stands are moving, then too short swings still.

    Written over whole runs with the future at hand, unlike the detector, which has no future.
    """
    phases = np.zeros(len(still), dtype=bool)
    edges = [0, *(np.flatnonzero(np.diff(still)) + 1), len(still)]
    standing = False
    for a, b in pairwise(edges):
        least = MIN_SWING if standing else MIN_STANCE
        lasts = b - a >= least
        if still[a] != standing and lasts:
            standing = not standing
        phases[a:b] = standing
    return phases


def as_if_known(session, before: np.ndarray, phases: np.ndarray, foot: int) -> bytes:
    """Return the state after the session's samples had ``phases`` been known all along."""
    w, n = session.space.w.copy(), session.space.n.copy()
    w[: lay.STATE] = before
    mask = ~(1 << foot)
    flags = n[lay.N_FLAGS : lay.N_FLAGS + len(phases)]
    flags[:] = (flags & mask) | (phases.astype(np.int64) << foot)
    quick_engine().rerun(w, n, 0, len(phases) - 1)
    return state_bits(w)


def shake(runs: list[int], foot: int):
    """Run a session; return it, its state before, the detector's own view, the false phases."""
    still, lead = stillness(runs), round(3.0 * RATE)
    pairs = shaken(still, foot, lead)
    config = TrackerConfig.from_mapping(MEMORY)
    session, start = open_session(config, pairs)
    space = session.space
    assert space.ring > len(still) + 2
    before, seen, false = space.w[: lay.STATE].copy(), [], 0
    for _ in follow(session, pairs, start):
        seen.append(space.w[lay.GLRT_LEFT + foot] < config.stance.threshold)
        bits = int(space.n[lay.N_NOTICE]) >> (foot * lay.NOTICE_SHIFT)
        false += bool(bits & (lay.STANCE_FALSE | lay.SWING_FALSE))
    return session, before, np.array(seen), false


@given(runs=st.lists(st.integers(1, 20), min_size=1, max_size=9), foot=st.sampled_from((0, 1)))
@settings(max_examples=60, deadline=None)
def test_the_state_is_as_if_the_phases_had_been_known_beforehand(runs, foot):
    session, before, seen, _ = shake(runs, foot)
    space, phases = session.space, cleaned(seen)
    undecided = {lay.LANDING: "N_START", lay.LEAVING: "N_LEAVE"}.get(space.foot(foot, "N_PHASE"))
    if undecided is not None:  # the newest phase may yet turn out to be too short
        phases[space.foot(foot, undecided) :] = seen[space.foot(foot, undecided) :]
    assert as_if_known(session, before, phases, foot) == state_bits(space.w)


@pytest.mark.parametrize(
    ("runs", "truth"),
    [([40, 40, 4, 40], [40, 84]), ([40, 4, 40], [84])],
    ids=["a false short stance", "a false short swing"],
)
def test_one_false_phase_leaves_no_trace(runs, truth):
    session, before, seen, false = shake(runs, 0)
    phases = cleaned(seen)
    assert false == 1
    assert len(set(np.flatnonzero(np.diff(phases)))) == len(truth) - 1
    assert as_if_known(session, before, phases, 0) == state_bits(session.space.w)
    assert as_if_known(session, before, seen, 0) != state_bits(session.space.w)


@pytest.mark.parametrize("method", ("idc", "spacing_vector"))
@pytest.mark.parametrize("std", (0.1, 0.01), ids=("fits", "often does not fit"))
def test_what_the_kernel_does_at_once_is_what_is_done_step_by_step(method, std, monkeypatch):
    name = f"{method}.{'distance' if method == 'idc' else 'spacing'}"
    given = {"method": method, name: 0.15 if std > 0.05 else 0.05, f"{name}_std": std}
    config, pairs = TrackerConfig.from_mapping({**given, **AS_IS}), walk(20.0)

    def followed():
        session, start = open_session(config, pairs)
        events = [event for _, found in follow(session, pairs, start) for event in found]
        return state_bits(session.space.w), events

    bits, events = followed()
    monkeypatch.setattr(WalkState, "end_in_kernel", lambda *_: None)
    again, expected = followed()
    constraints = [event for event in events if event.kind is EventKind.CONSTRAINT]
    assert len(constraints) > 10
    assert (std > 0.05) or any(event.reason is Reason.DID_NOT_FIT for event in constraints)
    assert bits == again
    assert repr(events) == repr(expected)
