"""The offset of two clocks is found from how the feet moved."""

from dataclasses import replace
from itertools import cycle, groupby

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import DualFootTracker, ImuSeries, TrackerConfig, swing_passings
from dualfoot_ros.core.results.events import EventKind
from dualfoot_ros.recording.importers import ImportOptions, import_recording
from dualfoot_ros.simulation import ClockConfig, WalkConfig, simulate
from dualfoot_ros.timing import Offset, TimingError, align, offset_by_motion

SECOND = 1_000_000_000


@pytest.fixture(scope="module")
def walk():
    found = simulate(WalkConfig(route="rectangle", rate=100.0), seed=4)
    return found.left, found.right


def cut(series, begin_s=0.0, end_s=0.0):
    stamps = series.stamp_ns
    return series[(stamps >= stamps[0] + begin_s * 1e9) & (stamps <= stamps[-1] - end_s * 1e9)]


def error_ms(found, right, shift_ns):
    """Return by how much a sample in the middle is moved wrongly; shift is what was added."""
    middle = right.stamp_ns[len(right) // 2 :][:1]
    return float(found.apply(middle)[0] - middle[0] + shift_ns) * 1e-6


@settings(max_examples=15, deadline=None)
@given(
    shift=st.floats(-5000.0, 5000.0),
    begin=st.tuples(st.floats(0.0, 14.0), st.floats(0.0, 14.0)),
    end=st.tuples(st.floats(0.0, 4.0), st.floats(0.0, 4.0)),
)
def test_any_offset_of_a_walk_is_recovered_wherever_the_recordings_were_started(
    walk, shift, begin, end
):
    left, right = (cut(s, b, e) for s, b, e in zip(walk, begin, end, strict=True))
    shift_ns = round(shift * 1e9)
    right = replace(right, stamp_ns=right.stamp_ns + shift_ns)
    found = offset_by_motion(left, right, "motion")
    assert abs(error_ms(found, right, shift_ns)) < 20.0
    assert found.confidence > 0.5


def test_the_attitude_of_the_sensors_on_the_shoes_does_not_matter(walk):
    left, right = walk
    turn = Rotation.from_euler("xyz", [100.0, -40.0, 20.0], degrees=True).as_matrix()
    turned = ImuSeries(right.stamp_ns, right.specific_force @ turn.T, right.angular_rate @ turn.T)
    one, two = (offset_by_motion(left, r, "motion") for r in (right, turned))
    assert one.offset_ns == pytest.approx(two.offset_ns, abs=1000)


def test_feet_exchanged_have_the_opposite_offset(walk):
    left, right = walk
    moved = replace(right, stamp_ns=right.stamp_ns + 7 * SECOND)
    there, back = offset_by_motion(left, moved, "motion"), offset_by_motion(moved, left, "motion")
    assert there.offset_ns == pytest.approx(-back.offset_ns, abs=1_000_000)


def test_the_skew_of_a_long_walk_is_found():
    clocks = ClockConfig(), ClockConfig(offset=-20.0, drift=150.0)
    found = simulate(WalkConfig(route="rectangle", laps=8), clock=clocks, seed=2)
    result = offset_by_motion(found.left, found.right, "motion")
    assert result.skew_known
    assert result.skew_ppm == pytest.approx(150.0, abs=60.0)
    moved = result.apply(found.right.stamp_ns)
    assert np.abs(moved - found.right_truth.stamp_ns).max() < 20_000_000


def test_standing_people_are_refused(walk):
    left, right = (series[:800] for series in walk)
    with pytest.raises(TimingError, match=r"do not walk together|no gait"):
        offset_by_motion(left, right, "motion")


def test_a_walk_without_start_or_end_is_found_doubtful(walk):
    left, right = (cut(s, 12.0, 12.0) for s in walk)
    whole = offset_by_motion(*walk, "motion")
    assert offset_by_motion(left, right, "motion").confidence < whole.confidence


def test_a_short_recording_is_refused_with_its_length(walk):
    with pytest.raises(TimingError, match=r"left foot is 2\.0 s long"):
        offset_by_motion(walk[0][:200], walk[1], "motion")


def test_an_unknown_method_is_refused(walk):
    with pytest.raises(TimingError, match=r"'guess'.*auto, motion, shake"):
        offset_by_motion(*walk, "guess")


def test_samples_that_are_no_numbers_and_stamps_that_repeat_do_no_harm(walk):
    left, right = walk
    force = right.specific_force.copy()
    force[1500:1503] = np.nan
    stamps = right.stamp_ns.copy()
    stamps[2000] = stamps[1999]
    found = offset_by_motion(left, ImuSeries(stamps, force, right.angular_rate), "motion")
    assert abs(error_ms(found, right, 0)) < 20.0


@given(
    offset=st.integers(-(10**16), 10**16),
    skew=st.floats(-9000.0, 9000.0),
    steps=st.lists(st.integers(1_000_000, 10**10), min_size=1, max_size=20),
)
def test_moved_stamps_keep_their_order_and_differ_by_offset_and_skew_alone(offset, skew, steps):
    stamps = 1_750_000_000 * SECOND + np.cumsum(steps)
    moved = Offset("motion", offset, int(stamps[0]), skew, True, 0.0, 1.0).apply(stamps)
    assert np.all(np.diff(moved) > 0)
    assert moved[0] == stamps[0] + offset
    ratio = (moved[-1] - moved[0] + 0.0) * (1.0 + 1e-6 * skew)
    assert ratio == pytest.approx(float(stamps[-1] - stamps[0]), rel=1e-9, abs=2.0)


def shaken(offset_s=0.0, drift_ppm=0.0, shakes=(2.0,), seed=0):
    """Return two recordings of one turning body, the right sensor mounted otherwise."""
    rng = np.random.default_rng(seed)
    amplitude, phase = rng.uniform(2.0, 6.0, (3, 4)), rng.uniform(0.0, 6.3, (3, 4))
    frequency = rng.uniform(0.8, 3.0, (3, 4))

    def rate(time):
        waves = np.sin(time[:, None, None] * 6.28 * frequency + phase) * amplitude
        on = np.any([np.abs(time - start - 2.5) < 2.5 for start in shakes], axis=0)
        return waves.sum(axis=2) * on[:, None]

    turn = Rotation.random(random_state=seed).as_matrix()
    series = []
    for foot in range(2):
        true = np.arange(0.0, 70.0, 0.01) + 0.0037 * foot
        stamp = true if foot == 0 else true * (1.0 + 1e-6 * drift_ppm) - offset_s
        measured = rate(true) if foot == 0 else rate(true) @ turn * 1.005
        noise = rng.normal(0.0, 0.02, (len(true), 3))
        force = np.tile([0.0, 0.0, 9.81], (len(true), 1))
        series.append(ImuSeries(np.round((stamp + 100.0) * 1e9), force, measured + noise))
    return series


@settings(max_examples=10, deadline=None)
@given(offset=st.floats(-3000.0, 3000.0), seed=st.integers(0, 1000))
def test_a_shake_gives_the_offset_to_two_milliseconds(offset, seed):
    left, right = shaken(offset, seed=seed)
    found = offset_by_motion(left, right)
    assert found.method == "shake"
    assert abs(error_ms(found, right, -round(offset * 1e9))) < 2.0
    assert found.confidence > 0.5


def test_two_shakes_give_the_skew():
    left, right = shaken(12.0, drift_ppm=300.0, shakes=(2.0, 60.0))
    found = offset_by_motion(left, right, "shake")
    assert found.skew_known
    assert found.skew_ppm == pytest.approx(300.0, abs=30.0)


def test_walking_is_not_taken_for_a_shake(walk):
    assert offset_by_motion(*walk).method == "motion"
    with pytest.raises(TimingError, match="no shake"):
        offset_by_motion(*walk, "shake")


def test_real_walks_on_one_clock_are_found_to_be(dual_feet):
    """Each walk is moved in one of three ways, and so is each folder."""
    errors = []
    ways = cycle(((3.217, (0.0, 0.0)), (-47.3, (5.0, 0.0)), (600.0, (0.0, 7.0))))
    for folder in ("rectangle_ccw", "rectangle_cw", "figure_eight", "running_track"):
        for path in sorted((dual_feet / folder).glob("*.mat")):
            recording = import_recording(ImportOptions(sources=(path,)))
            shift, begins = next(ways)
            left, right = cut(recording.left, begins[0]), cut(recording.right, begins[1])
            moved = replace(right, stamp_ns=right.stamp_ns + round(shift * 1e9))
            found = offset_by_motion(left, moved)
            assert found.method == "motion"
            errors.append(error_ms(found, moved, round(shift * 1e9)))
    assert len(errors) >= 27
    assert np.sqrt(np.mean(np.square(errors))) < 7.0
    assert np.abs(errors).max() < 15.0


@pytest.mark.parametrize("method", ["idc", "spacing_vector"])
@pytest.mark.parametrize("number", range(1, 6))
def test_unsynchronised_real_walks_become_sensible_dual_foot_tracks(dual_feet, number, method):
    path = dual_feet / "unsynchronised" / f"HR_2Laces_ccw_{number}.mat"
    recording = import_recording(ImportOptions(sources=(path,)))
    found = offset_by_motion(recording.left, recording.right)
    assert found.offset_ns * 1e-9 == pytest.approx(162.476, abs=0.01)
    assert found.confidence > 0.7
    pair = align(recording.left, found.moved(recording.right))
    config = TrackerConfig.from_mapping({"method": method})
    track = DualFootTracker(config, engine="compiled").run(*pair)
    starts = sorted((e.stamp_ns, e.foot) for e in track.events if e.kind is EventKind.STANCE_START)
    turns = [len(list(run)) for _, run in groupby(foot for _, foot in starts[2:])]
    assert len(turns) >= 38
    assert sum(n > 1 for n in turns) <= 2  # at a stop a foot may come to rest twice
    passed = swing_passings(
        track.left.position, track.right.position, track.left.stance, track.right.stance
    )
    at_least = [e.detail["distance"] for e in track.events if e.kind is EventKind.CONSTRAINT]
    assert len(at_least) > 25
    assert 0.1 < np.median(at_least) < 0.25
    assert passed.crossed_percent < 20.0
    for foot in (track.left, track.right):
        assert foot.distance_m == pytest.approx(23.0, abs=1.5)
        assert np.linalg.norm(foot.position[-1, :2] - foot.position[0, :2]) < 0.4
