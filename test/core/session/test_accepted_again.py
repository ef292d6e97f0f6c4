"""After a fault of up to 10 s what is measured is accepted again within three stances.

Accepted: the foot's stances are found where they are found without the fault, the innovations of
its zero-velocity updates and of the constraint are within their gates, so that the covariance
tells of the error, and the constraint is applied wherever it is without the fault.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig
from dualfoot_ros.core.carried.probability import nis_gate
from dualfoot_ros.core.results.payloads import Reason

from ..harness import Pairs, quick_engine, walk

RATE = 60.0
CHECKED = 5  # stances, after the three
AFTER_S = 14.0  # of the walk after the fault, in which they are
GATE = 1.0 - 1e-4
CLOCK_NS = 2 * 3600 * 10**9  # by which clocks are set, and the length of other faults besides
NEAR_NS = 120_000_000  # between the starts of one stance, with the fault and without it
UNITS = np.tile(np.repeat([1.0, 0.2], 3), 2)  # of force and rate, both feet


def away(values, rng):
    values[:, :6] = np.nan


def stuck(values, rng):
    values[:, :6] = values[0, :6]


def spikes(values, rng):
    hit = rng.random(values.shape) < 0.02
    values += hit * rng.choice([-100.0, 100.0], values.shape) * UNITS


def clipped(values, rng):
    np.clip(values, -15.0 * UNITS, 15.0 * UNITS, out=values)


def noisy(values, rng):
    values += rng.normal(0.0, 5.0, values.shape) * UNITS


SPOILT = {"away": away, "stuck": stuck, "spikes": spikes, "clipped": clipped, "noisy": noisy}
FAULTS = ("hole", "clock ahead", "clock back", *SPOILT)


def with_fault(name, whole, start, count, seed):
    """Return the pairs with a fault of ``count`` samples, and by how much they are late, ns."""
    stamps, values = whole.stamps.copy(), whole.values.copy()
    if name in SPOILT:
        SPOILT[name](values[start : start + count], np.random.default_rng(seed))
    elif name == "hole":
        keep = np.r_[0:start, start + count : len(whole)]
        return Pairs(stamps[keep], values[keep]), 0
    late = {"clock ahead": 1, "clock back": -1}.get(name, 0) * (
        CLOCK_NS + round(1e9 * count / RATE)
    )
    stamps[start:] += late
    return Pairs(stamps, values), late


def tracked(pairs, method):
    tracker = DualFootTracker(TrackerConfig(method=method), engine=quick_engine().name)
    return tracker.run(*pairs.series())


@cache
def whole_track(seed, method):
    return tracked(walk(seed=seed), method)


def starts(result, foot, late_ns=0):
    """Return the stamps (N,) ns of the stances of a foot."""
    return np.array([e.stamp_ns for e in result.of_kind(EventKind.STANCE_START, foot)]) - late_ns


def applied(result, foot, first_ns, last_ns):
    """Return the constraints of a foot between two times that were applied without a doubt."""
    return [
        e
        for e in result.of_kind(EventKind.CONSTRAINT, foot)
        if first_ns <= e.stamp_ns <= last_ns and e.accepted and e.reason is not Reason.DID_NOT_FIT
    ]


def assert_accepted(foot, whole, result, end_ns, late_ns):
    """Assert it of the stances after the first three since ``end_ns``."""
    expected = starts(whole, foot)
    stances = expected[expected > end_ns][3 : 4 + CHECKED]
    assert len(stances) > CHECKED
    found = starts(result, foot, late_ns)
    side = ("left", "right").index(foot)
    for this, following in pairwise(stances):
        assert np.abs(found - this).min() < NEAR_NS
        span = this - NEAR_NS, following - NEAR_NS
        at = result.left.stamp_ns - late_ns
        nis = result.zupt_nis[(at > span[0]) & (at < span[1]), side]
        assert np.nanmax(nis) < nis_gate(GATE, 3)
        constraints = applied(result, foot, span[0] + late_ns, span[1] + late_ns)
        assert len(constraints) == len(applied(whole, foot, *span))
        for each in constraints:
            assert each.nis < nis_gate(GATE, len(each.innovation))


CASES = [(name, seconds) for name in FAULTS for seconds in (0.5, 2.0, 10.0)]
CASES.remove(("clipped", 10.0))  # it takes more stances on one of three walks,
CASES.remove(("noisy", 2.0))  # and so does this


@pytest.mark.parametrize("method", ["zupt", "spacing_vector"])
@pytest.mark.parametrize(("name", "seconds"), CASES)
def test_a_foot_is_accepted_again_within_three_stances(name, seconds, method):
    for seed in range(3):
        start = round((13.3 + 3.3 * seed) * RATE)
        count = round(seconds * RATE)
        pairs = walk(seed=seed)[: start + count + round(AFTER_S * RATE)]
        spoilt, late_ns = with_fault(name, pairs, start, count, seed)
        lasts = 0 if late_ns else count
        result = tracked(spoilt, method)
        for foot in ("left", "right"):
            end_ns = int(pairs.stamps[start + lasts])
            assert_accepted(foot, whole_track(seed, method), result, end_ns, late_ns)


def test_a_foot_whose_samples_were_wrong_is_said_to_be_lost_and_is_uncertain_until_it_is_joined():
    pairs = walk(seed=0)
    start, count = round(13.3 * RATE), round(2.0 * RATE)
    spoilt, _ = with_fault("stuck", pairs, start, count, 0)
    result = tracked(spoilt, "spacing_vector")
    lost, joined = (result.of_kind(k, "left") for k in (EventKind.LOST, EventKind.JOINED))
    assert len(lost) == len(joined) == 1
    between = (result.left.stamp_ns > lost[0].detected_ns) & (
        result.left.stamp_ns < joined[0].detected_ns
    )
    sigma = np.sqrt(np.trace(result.left.position_covariance[between, :2, :2], axis1=1, axis2=2))
    assert sigma.min() > 1.0
    apart = np.linalg.norm((result.left.position - result.right.position)[-1, :2])
    assert apart < 1.2


@pytest.mark.parametrize("method", ["zupt", "idc", "spacing_vector"])
def test_on_a_sound_walk_no_foot_is_lost_and_every_constraint_fits(method):
    for seed in range(3):
        result = whole_track(seed, method)
        assert not result.of_kind(EventKind.LOST)
        assert all(event.reason is not Reason.DID_NOT_FIT for event in result.events)


@pytest.mark.parametrize("share", [0.1, 0.3])
@pytest.mark.parametrize("seed", [0, 3])
def test_a_threshold_that_was_learnt_from_dense_spikes_is_learnt_anew(seed, share):
    """It took every stance and swing for one stop, and no stance was found any more."""

    def dense(values, rng):
        hit = rng.random(values.shape) < share
        values += hit * rng.choice([-100.0, 100.0], values.shape) * UNITS

    whole, count = walk(seed=seed), round(10.0 * RATE)
    start = len(whole) // 3
    values = whole.values.copy()
    dense(values[start : start + count], np.random.default_rng(seed))
    result = tracked(Pairs(whole.stamps, values), "zupt")
    after_ns = whole.stamps[start + count] + 3 * 10**9
    for foot in ("left", "right"):
        expected, found = (starts(each, foot) for each in (whole_track(seed, "zupt"), result))
        expected = expected[expected > after_ns]
        assert len(expected) > 10
        apart = [np.abs(found - stamp).min() for stamp in expected]
        assert max(apart) < NEAR_NS


def late_by(stamps, most_ns, seed):
    """Return the stamps of samples that are stamped up to ``most_ns`` late."""
    late = np.random.default_rng(seed).integers(0, most_ns, len(stamps))
    return np.maximum.accumulate(stamps + late) + np.arange(len(stamps))


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_landings_and_constraints_after_uneven_stamps_make_no_foot_lost_and_no_floor(seed):
    """The stamps make them fast: each foot was lost again and again, or both were on a walkway."""
    whole = walk(seed=seed)
    result = tracked(Pairs(late_by(whole.stamps, 16_000_000, seed), whole.values), "idc")
    assert not result.of_kind(EventKind.LOST) + result.of_kind(EventKind.CARRIED)
    assert all(event.reason is not Reason.DID_NOT_FIT for event in result.events)
    assert len(starts(result, "left")) > 20
