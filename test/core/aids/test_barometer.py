"""The barometer aid: height in stance, from the sensor of the foot or of the body."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import (
    ConfigError,
    DualFootTracker,
    EventKind,
    PressureSeries,
    TrackerConfig,
)
from dualfoot_ros.core.aids import height_pressure
from dualfoot_ros.core.results.trajectory import stance_bounds
from dualfoot_ros.simulation import BarometerConfig, SensorConfig, WalkConfig, simulate
from dualfoot_ros.timing import align

from ..following import live, same_bits
from ..harness import Pairs, quick_engine, stack_pairs

ENGINE = quick_engine().name
EXACT = BarometerConfig(noise=0.0, offset=0.0, drift=0.0, temperature=15.0)
FIRM = {"aids.barometer_std": 0.01}
DRIFTING = {"zupt.lever_back": 0.0}  # with the pivot below the sensor level walks climb
SECOND = 1_000_000_000


@cache
def climb(barometer: BarometerConfig = EXACT, seed: int = 0):
    """Return a simulated walk up and down stairs."""
    walk = WalkConfig(route="stairs", rate=60.0, standing=4.0, final_standing=2.0)
    return simulate(walk, SensorConfig(), seed=seed, barometer=barometer)


def tracker(**settings) -> DualFootTracker:
    """Return a tracker with the barometer on."""
    given = {"aids.barometer": True, **settings}
    return DualFootTracker(TrackerConfig.from_mapping(given), engine=ENGINE)


def tracked(made, used: DualFootTracker, pressure=None):
    """Return what a tracker makes of a simulated walk and its pressure."""
    left, right = align(made.left, made.right)
    return used.run(left, right, made.pressure if pressure is None else pressure)


def height_errors(made, result) -> np.ndarray:
    """Return (M,) errors of the height in the middle of each stance, against the first's, m."""
    errors = []
    for track, truth in ((result.left, made.left_truth), (result.right, made.right_truth)):
        middles = stance_bounds(track.stance).mean(axis=1).astype(int)
        true = np.interp(track.stamp_ns[middles], truth.stamp_ns, truth.position[:, 2])
        error = track.position[middles, 2] - true
        errors.append(error - error[0])
    return np.concatenate(errors)


def rms(values) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


@pytest.mark.parametrize(("worn", "limit"), [("feet", 0.02), ("body", 0.10)])
def test_an_exact_barometer_gives_the_climb_back(worn, limit):
    """On the body less well: it rises and falls over a standing foot by up to a step."""
    made = climb(replace(EXACT, worn=worn))
    truth = made.left_truth.position[:, 2]
    assert truth.max() - truth.min() > 3.0
    assert rms(height_errors(made, tracked(made, tracker(**FIRM)))) < limit


def test_noisy_barometers_take_the_drift_out_of_the_height():
    """Over six walks on stairs of a minute: (RMS, with against without)."""
    with_it, without = [], []
    for seed in range(6):
        made = climb(BarometerConfig(), seed)
        with_it.append(height_errors(made, tracked(made, tracker(**DRIFTING))))
        off = tracker(**DRIFTING, **{"aids.barometer": False})
        without.append(height_errors(made, tracked(made, off)))
    assert rms(np.concatenate(with_it)) < 0.8 * rms(np.concatenate(without))


def test_on_a_lap_of_400_m_the_height_no_longer_runs_away():
    """What is left is mostly the drift of the pressure."""
    lap = WalkConfig(route="track", rate=60.0, standing=4.0)
    made = simulate(lap, SensorConfig(), seed=0, barometer=BarometerConfig())
    off = tracker(**DRIFTING, **{"aids.barometer": False})
    assert rms(height_errors(made, tracked(made, off))) > 1.5
    assert rms(height_errors(made, tracked(made, tracker(**DRIFTING)))) < 0.4


def test_each_stance_but_the_first_is_observed_once():
    made = climb()
    used = tracker()
    result = tracked(made, used)
    for foot, track in (("left", result.left), ("right", result.right)):
        events = result.of_kind(EventKind.AID, foot)
        assert not events[0].accepted
        assert events[0].detail["reason"] == "reference of the first stance"
        assert all(event.accepted for event in events[1:])
        ended = len(stance_bounds(track.stance)) - 1  # the last stance goes on to the end
        assert len(events) == ended
        stamps = [event.stamp_ns for event in events]
        assert stamps == sorted(set(stamps))
    assert used.counters["stances_without_pressure"] == 0


def test_a_foot_uses_its_own_sensor_and_the_bodys_where_it_has_none():
    made = climb()
    body = PressureSeries(made.pressure["left"].stamp_ns, made.pressure["left"].pressure - 500.0)
    sensors = {"right": made.pressure["right"], "both": body}
    result = tracked(made, tracker(**FIRM), sensors)
    worn = {
        foot: {event.detail["worn"] for event in result.of_kind(EventKind.AID, foot)}
        for foot in ("left", "right")
    }
    assert worn == {"left": {"both"}, "right": {"right"}}
    assert rms(height_errors(made, result)) < 0.03  # the 40 m between the two do not matter


def test_a_change_of_sensor_begins_with_a_reference_of_its_own():
    made = climb()
    whole = made.pressure["left"]
    half = len(whole) // 2
    first = PressureSeries(whole.stamp_ns[:half], whole.pressure[:half])
    body = PressureSeries(whole.stamp_ns, whole.pressure - 500.0)
    result = tracked(made, tracker(), {"left": first, "both": body})
    events = result.of_kind(EventKind.AID, "left")
    assert [e.detail["worn"] for e in events if not e.accepted] == ["left", "both"]
    assert abs(height_errors(made, result)).max() < 0.5


def test_an_offset_of_the_sensor_changes_next_to_nothing():
    made = climb()
    shifted = {
        worn: PressureSeries(each.stamp_ns, each.pressure - 1200.0)  # about 100 m
        for worn, each in made.pressure.items()
    }
    one, other = tracked(made, tracker()), tracked(made, tracker(), shifted)
    assert np.abs(one.left.position[:, 2] - other.left.position[:, 2]).max() < 0.05


def pairs_of(made) -> Pairs:
    left, right = align(made.left, made.right)
    return Pairs(left.stamp_ns, stack_pairs(left, right))


def fed_live(used: DualFootTracker, pairs: Pairs, pressure, ahead_ns: int = 0):
    """Feed pairs and pressure in the order of their stamps; return what came out."""
    samples = sorted(
        (int(stamp), worn, float(pascal))
        for worn, each in pressure.items()
        for stamp, pascal in zip(each.stamp_ns, each.pressure, strict=True)
    )
    found = None
    for k, pair in enumerate(pairs):
        while samples and samples[0][0] <= pair.stamp_ns + ahead_ns:
            stamp, worn, pascal = samples.pop(0)
            used.add_pressure(worn, stamp, pascal)
        found = live(used, pairs[k : k + 1], found)
    for stamp, worn, pascal in samples:
        used.add_pressure(worn, stamp, pascal)
    return found


@pytest.mark.parametrize("ahead_ns", [0, 3 * SECOND])
def test_live_gives_the_same_bits_as_batch_however_far_the_pressure_is_ahead(ahead_ns):
    made = climb(BarometerConfig(), 1)
    batch, one_by_one = tracker(), tracker()
    found = fed_live(one_by_one, pairs_of(made), made.pressure, ahead_ns)
    same_bits(found, tracked(made, batch))
    assert batch.counters == one_by_one.counters


def test_a_long_stand_before_the_walk_gives_the_same_bits_live_and_batch():
    """Longer than what a live tracker remembers of the pressure."""
    walk = WalkConfig(route="L", rate=60.0, standing=150.0, final_standing=1.0)
    made = simulate(walk, seed=0, barometer=BarometerConfig(rate=10.0))
    batch, one_by_one = tracker(), tracker()
    found = fed_live(one_by_one, pairs_of(made), made.pressure)
    same_bits(found, tracked(made, batch))


def test_pressure_changes_nothing_while_the_aid_is_off_and_is_counted_as_unused():
    made = climb()
    off, plain = tracker(**{"aids.barometer": False}), tracker(**{"aids.barometer": False})
    one, other = tracked(made, off), tracked(made, plain, {})
    assert one.left.position.tobytes() == other.left.position.tobytes()
    assert off.counters["pressure_unused"] == sum(map(len, made.pressure.values()))
    assert off.add_pressure("left", 0, 101325.0) == "pressure_unused"
    assert off.counters["pressures"] == 0


def test_without_any_pressure_the_aid_does_nothing_and_counts_the_stances():
    made = climb()
    on, off = tracker(), tracker(**{"aids.barometer": False})
    one, other = tracked(made, on, {}), tracked(made, off, {})
    assert one.left.position.tobytes() == other.left.position.tobytes()
    ended = len(one.of_kind(EventKind.STANCE_END))
    assert on.counters["stances_without_pressure"] == ended > 60


def test_bad_pressure_is_refused_and_counted_by_name():
    used = tracker()
    assert used.add_pressure("left", 5 * SECOND, 101325.0) is None
    for stamp in (5 * SECOND, 5 * SECOND - 1):
        assert used.add_pressure("left", stamp, 101325.0) == "pressure_out_of_order"
    for pascal in (float("nan"), float("inf"), -1.0, 1013.25, 1e6):
        assert used.add_pressure("both", 6 * SECOND, pascal) == "pressure_out_of_range"
    assert used.add_pressure("right", 1, 101325.0) is None  # each sensor has its own order
    assert (used.counters["pressures"], used.counters["pressure_out_of_order"]) == (2, 2)
    assert used.counters["pressure_out_of_range"] == 5


@pytest.mark.parametrize("worn", ["hat", "", "LEFT"])
def test_pressure_of_what_is_worn_nowhere_is_refused_with_what_is_allowed(worn):
    with pytest.raises(ConfigError, match="allowed is one of left, right, both"):
        tracker().add_pressure(worn, 0, 101325.0)


def test_set_pose_takes_the_reference_along():
    """Put 7 m higher in the middle of the walk, a foot keeps climbing from there."""
    made = climb()
    pairs, used, shift_m = pairs_of(made), tracker(**FIRM), 7.0
    samples = [
        (worn, int(s), float(p))
        for worn, each in made.pressure.items()
        for s, p in zip(each.stamp_ns, each.pressure, strict=True)
    ]
    for sample in samples:
        used._inputs.take_pressure(*sample)
    middle, heights = len(pairs) // 2, []
    for k, pair in enumerate(pairs):
        update = used.add(pair)
        if k == middle:
            person = update.pedestrian()
            x, y, z = person.position
            used.set_pose([x, y, z + shift_m], person.heading)
        if update.row is not None:
            heights.append((pair.stamp_ns, update.left.position[2]))
    plain = tracked(made, tracker(**FIRM))
    stamps, moved = np.array(heights).T
    before = np.interp(stamps, plain.left.stamp_ns, plain.left.position[:, 2])
    late = stamps > pairs.stamps[middle] + 2 * SECOND
    np.testing.assert_allclose((moved - before)[late], shift_m, atol=0.05)


def test_a_reset_measures_against_the_first_stance_after_it():
    """Reset on the upper floor: the track starts anew at height zero, and stays there."""
    standing = WalkConfig(route="straight", rate=60.0, standing=4.0, final_standing=2.0)
    made = simulate(standing, seed=2, barometer=EXACT)
    used, pairs = tracker(**FIRM), pairs_of(made)
    fed_live(used, pairs, made.pressure)
    used.reset()
    late = 600 * SECOND
    upstairs = height_pressure(100.0) - height_pressure(110.0)
    higher = {
        worn: PressureSeries(each.stamp_ns + late, each.pressure - upstairs)
        for worn, each in made.pressure.items()
    }
    found = fed_live(used, Pairs(pairs.stamps + late, pairs.values), higher)
    heights = found.turned()[:, [2, 2 + 45]]
    assert used.counters["resets"] == 1
    assert np.abs(heights[-1]).max() < 0.2
