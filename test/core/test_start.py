"""A track starts from what is there: a quiet stand, a restless one, or the first stances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, ImuPair, TrackerConfig, bias_after
from dualfoot_ros.core.alignment import Alignment
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import Gait, WalkConfig, grade, simulate

from .following import live, same_bits
from .harness import Pairs, quick_engine

ENGINE = quick_engine().name
RATE = 100.0


def made(seed: int = 5, **options):
    return simulate(
        WalkConfig(route="straight", rate=RATE, **options), grade("consumer"), seed=seed
    )


def run(left, right, **options):
    config = TrackerConfig.from_mapping({"method": "zupt", **options})
    return DualFootTracker(config, engine=ENGINE).run(left, right)


def start_of(result) -> dict:
    (event,) = result.of_kind(EventKind.ALIGNED)
    return event.detail


def way_of(track) -> float:
    return float(np.linalg.norm(track.position[-1, :2] - track.position[0, :2]))


def test_a_person_who_stands_quietly_starts_at_once():
    walk = made(standing=5.0)
    result = run(walk.left, walk.right)
    assert start_of(result)["start"] == "stand"
    assert (result.start_ns - int(walk.left.stamp_ns[0])) * 1e-9 < 3.2


def test_a_person_who_sways_starts_all_the_same_with_a_less_certain_bias():
    calm, swaying = (made(standing=6.0, gait=Gait(tremor=t)) for t in (0.002, 0.04))
    found = [run(walk.left, walk.right) for walk in (calm, swaying)]
    stds = [start_of(result)["gyro_bias_std"] for result in found]
    assert start_of(found[1])["start"] == "restless_stand"
    assert stds[1] > 2.0 * stds[0]
    assert way_of(found[1].left) == pytest.approx(way_of(found[0].left), rel=0.05)


@pytest.mark.parametrize("patience", (2.0, 6.0))
def test_live_output_begins_after_the_patience_when_no_better_stand_comes(patience):
    walk = made(standing=12.0, gait=Gait(tremor=0.04))
    config = TrackerConfig.from_mapping({"alignment.patience": patience})
    tracker = DualFootTracker(config, engine=ENGINE)
    begin = int(walk.left.stamp_ns[0])
    values = np.hstack(
        [np.hstack([s.specific_force, s.angular_rate]) for s in (walk.left, walk.right)]
    )
    for stamp, row in zip(walk.left.stamp_ns.tolist(), values, strict=True):
        if tracker.add(ImuPair(stamp, row)).row is not None:
            break
    assert (stamp - begin) * 1e-9 < patience + 2.0


def test_a_walk_without_any_stand_starts_from_its_first_stances():
    walk = made(standing=5.0, final_standing=0.5)
    whole = run(walk.left, walk.right)
    moving = slice(round(7.0 * RATE), None)
    result = run(walk.left[moving], walk.right[moving])
    assert start_of(result)["start"] == "first_stance"
    missing_m = whole.left.position[whole.left.stamp_ns >= result.start_ns][0]
    rest = np.linalg.norm((whole.left.position[-1] - missing_m)[:2])
    assert way_of(result.left) == pytest.approx(rest, rel=0.06)


def alone(series):
    """Return the series of a foot whose other foot has no sensor, as that of the other foot."""
    nothing = np.full((len(series), 3), np.nan)
    return replace(series, specific_force=nothing, angular_rate=nothing)


@pytest.mark.parametrize(
    ("standing", "cut_s", "kind"), [(1.2, 0.0, "restless_stand"), (5.0, 7.0, "first_stance")]
)
def test_one_foot_alone_starts_as_two_do(standing, cut_s, kind):
    walk = made(standing=standing, final_standing=0.5)
    moving = slice(round(cut_s * RATE), None)
    left, right = walk.left[moving], walk.right[moving]
    both, one = run(left, right), run(left, alone(right))
    assert start_of(one)["start"] == start_of(both)["start"] == kind
    assert way_of(one.left) == pytest.approx(way_of(both.left), rel=0.06)


@pytest.mark.parametrize("cut_s", [0.0, 2.5], ids=["restless stand", "first stances"])
@pytest.mark.parametrize("feet", [1, 2])
def test_a_start_that_pairs_wait_for_has_the_bits_of_the_batch_run(feet, cut_s):
    walk = made(standing=1.2, final_standing=2.0)
    moving = slice(round(cut_s * RATE), round(20.0 * RATE))
    left, right = walk.left[moving], walk.right[moving]
    right = right if feet == 2 else alone(right)
    pairs = Pairs(left.stamp_ns, stack_pairs(left, right))
    followed = live(DualFootTracker(engine=ENGINE), pairs)
    assert {e.detail["start"] for e in followed.events if e.kind is EventKind.ALIGNED} == {
        "restless_stand" if cut_s == 0.0 else "first_stance"
    }
    same_bits(followed, DualFootTracker(engine=ENGINE).run(left, right))


def test_a_foot_that_begins_a_second_late_is_waited_for():
    walk = made(standing=3.0)
    late = walk.right.stamp_ns < walk.right.stamp_ns[0] + 1_000_000_000
    nothing = alone(walk.right)
    right = replace(
        walk.right,
        specific_force=np.where(late[:, None], nothing.specific_force, walk.right.specific_force),
        angular_rate=np.where(late[:, None], nothing.angular_rate, walk.right.angular_rate),
    )
    result = run(walk.left, right, **{"alignment.patience": 0.0})
    assert result.right.present.all()
    assert (result.start_ns - int(walk.left.stamp_ns[0])) * 1e-9 > 1.0


@pytest.mark.parametrize("seed", range(3))
def test_a_stand_at_the_end_tells_the_bias_of_a_walk_that_had_none(seed):
    walk = made(seed, standing=6.0, final_standing=8.0)
    known = start_of(run(walk.left, walk.right))
    moving = slice(round(8.0 * RATE), None)
    left, right = walk.left[moving], walk.right[moving]
    tracker = DualFootTracker(TrackerConfig(method="zupt"), engine=ENGINE)
    for foot, series in (("left", left), ("right", right)):
        prior = bias_after(series, tracker.config)
        assert np.abs(prior.mean - known[f"{foot}_gyro_bias"]).max() < 4.0 * max(
            prior.std, known["gyro_bias_std"]
        )
        tracker.declare_bias(foot, prior)
    started = start_of(tracker.run(left, right))
    assert started["start"] == "first_stance" and started["gyro_bias_std"] < 2e-3


def test_a_walk_that_ends_in_motion_has_no_last_stand():
    walk = made(standing=5.0, final_standing=0.5)
    moving = slice(round(7.0 * RATE), round(12.0 * RATE))
    assert bias_after(walk.left[moving], TrackerConfig()) is None


def test_every_stand_of_the_walk_teaches_the_bias_anew():
    walk = made(standing=5.0, stops=2, stop_duration=8.0)
    result = run(walk.left, walk.right)
    stood = result.of_kind(EventKind.STOOD)
    assert {event.foot for event in stood} == {"left", "right"} and len(stood) >= 4
    assert all(event.detail["gyro_bias_std"] < 2e-3 for event in stood)
    assert all(event.nis < 30.0 for event in stood)


def content(alignment) -> tuple:
    """Return all that an alignment holds but for the room behind its samples."""
    feet = [
        (watch.seen_ns, watch.quiet_s, watch.restarts, watch.complaint, held(watch), stood(watch))
        for watch in alignment._watches
    ]
    waiting = [(stamp, row.tobytes()) for stamp, row in alignment._waiting]
    return feet, waiting, alignment.rate.hz, alignment._since_ns, str(alignment._candidate)


def held(watch) -> list:
    sliders = watch._slider, watch._short
    rows = [s._rows.rows().tobytes() for s in sliders]
    return [(list(s._stamps), s._due_ns, row) for s, row in zip(sliders, rows, strict=True)]


def stood(watch) -> tuple:
    stand = watch.stand
    return stand.count, stand.seconds, stand._mean, stand._spread, str(watch._still)


@pytest.mark.parametrize("tremor", [0.002, 0.04])
@pytest.mark.parametrize("size", [9, 37, 5000])
def test_pairs_taken_many_at_once_leave_what_those_taken_one_by_one_leave(tremor, size):
    walk = made(standing=7.0, gait=Gait(tremor=tremor))
    config = TrackerConfig.from_mapping({"alignment.patience": 4.0})
    stamps, values = walk.left.stamp_ns, stack_pairs(walk.left, walk.right)
    alone, many = Alignment(config), Alignment(config)
    k, together = 0, 0
    while k < len(stamps):
        start, taken = None, 0
        if many.takes_many:
            taken, start = many.add_all(stamps[k : k + size], values[k : k + size])
        if taken == 0:
            taken, start = 1, many.add(int(stamps[k]), values[k])
        else:
            together += taken
        for row in range(k, k + taken):
            expected = alone.add(int(stamps[row]), values[row])
            assert expected is None or row == k + taken - 1
        k += taken
        assert content(many) == content(alone)
        assert str(start) == str(expected)
        if start is not None:
            break
    assert together > 100 and str(start.kind) == ("stand" if tremor < 0.01 else "restless_stand")
