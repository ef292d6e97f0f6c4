"""Findings on a recording: each kind of bad input has its own, good input has none."""

from dataclasses import replace

import numpy as np
import pytest
from recording.samples import GRAVITY, RATE_HZ, moving

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.inspection.findings import check_usable, findings_of, require_usable
from dualfoot_ros.inspection.quality import clipped, quality_of
from dualfoot_ros.recording import Recording, RecordingError, Topics
from dualfoot_ros.simulation import WalkConfig, simulate


def scaled(series, force=1.0, rate=1.0):
    return ImuSeries(series.stamp_ns, series.specific_force * force, series.angular_rate * rate)


def of(left=None, right=None):
    return Recording(moving(1) if left is None else left, moving(2) if right is None else right)


def named(recording):
    return {finding.kind for finding in findings_of(recording)}


def test_a_good_recording_has_no_finding():
    assert named(of()) == set()
    left, right = require_usable(of())
    assert len(left) == len(right) == 1200


def with_nan(series):
    series.angular_rate[700, 1] = np.nan
    return series


BAD = [
    (Recording(), "missing", "no samples of either foot"),
    (
        Recording(left=moving(1)),
        "missing",
        "no samples of the right foot, and both feet",
    ),
    (of(right=moving(2)[:0]), "missing", "no samples of the right foot"),
    (of(left=moving(1)[:1]), "empty", "left foot: 1 of 1 samples can be used"),
    (of(left=with_nan(moving(1))), "not_finite", "left foot: 1 of 1200 samples .* sample 700"),
    (of(left=scaled(moving(1), force=1 / GRAVITY)), "force_unit", "left foot.* in g and not"),
    (of(right=scaled(moving(2), force=1e3 / GRAVITY)), "force_unit", "right foot.* in mg and"),
    (of(right=scaled(moving(2), force=0.01)), "force_unit", "gravity was taken out"),
    (of(right=scaled(moving(2), force=2.0)), "force_unit", "9.8 m/s\\^2 is due"),
    (of(right=scaled(moving(2), rate=180 / np.pi)), "rate_unit", "right foot.* in deg/s and not"),
    (
        of(right=moving(2, start_ns=10**18 + 10**11)),
        "no_overlap",
        "do not overlap.*dualfoot sync.*--right-offset",
    ),
]


@pytest.mark.parametrize(("recording", "name", "sentence"), BAD)
def test_what_cannot_be_used_is_refused_with_a_sentence(recording, name, sentence):
    assert name in named(recording)
    with pytest.raises(RecordingError, match=sentence):
        require_usable(recording)


def test_a_foot_that_is_missing_is_a_warning_as_the_other_one_is_tracked_alone():
    (finding,) = check_usable(Recording(left=moving(1)))
    assert finding.kind is FindingKind.MISSING and finding.about == "right"
    assert "so the left foot is tracked alone" in finding.text


def test_a_foot_that_begins_late_or_ends_early_is_a_warning_with_the_time():
    late, early = of(left=moving(1)[450:]), of(right=moving(2)[:700])
    for recording, words in ((late, "left foot begins 4.5 s"), (early, "right foot ends 5.0 s")):
        (finding,) = (f for f in check_usable(recording) if f.kind is FindingKind.ONE_FOOT)
        assert words in finding.text and "tracked alone" in finding.text
    assert "one_foot" not in named(of(right=moving(2)[:1000]))


def test_a_topic_that_was_asked_for_by_name_must_be_there():
    topics = replace(Topics(), right=replace(Topics().right, imu="/imu"))
    with pytest.raises(RecordingError, match="no samples of the right foot"):
        check_usable(Recording(left=moving(1), topics=topics))


def test_two_recordings_in_one_are_refused():
    left = moving(1)
    stamps = np.concatenate([left.stamp_ns[:600], left.stamp_ns[:600]])
    with pytest.raises(RecordingError, match="two recordings in one"):
        require_usable(of(left=replace(left, stamp_ns=stamps)))


def test_samples_that_are_not_finite_can_be_let_through_to_be_counted():
    left, _ = require_usable(of(left=with_nan(moving(1))), allow_not_finite=True)
    assert np.isnan(left.angular_rate).sum() == 1


def test_a_foot_that_never_stands_still_is_found():
    assert named(of(left=moving(1, stand=0))) == {"no_standstill"}


def test_a_missing_topic_is_told_with_the_topics_that_are_there():
    recording = Recording(imu_topics=("/imu_a", "/imu_b"))
    with pytest.raises(RecordingError, match=r"--left-topic.*/imu_a, /imu_b"):
        require_usable(recording)


def test_gaps_duplicates_and_different_rates_are_warnings():
    left = moving(1)[np.r_[0:600, 605, 605, 650:1200]]
    right = moving(2)[::2]
    assert {"gaps", "stamps", "rates"} <= named(of(left, right))
    require_usable(of(left, right))


def test_a_sensor_at_the_end_of_its_range_is_a_warning():
    left = moving(1)
    left.specific_force[:, 0] = np.clip(left.specific_force[:, 0], -16.0, 8.0)
    assert "clipping" not in named(of(left))  # 8 m/s^2 is no range of any sensor
    left.specific_force[:] *= [4.0, 1.0, 1.0]
    assert "clipping" in named(of(left))


def test_an_extreme_that_occurs_once_is_no_clipping():
    values = np.random.default_rng(0).normal(0.0, 20.0, (1000, 3))
    assert clipped(values, 15.0) == 0
    values[10:13, 1] = values.max() + 1.0
    assert clipped(values, 15.0) == 3


def test_two_equal_samples_at_one_peak_are_no_clipping():
    values = np.random.default_rng(0).normal(0.0, 20.0, (1000, 3))
    values[10:12, 1] = values.max() + 1.0
    assert clipped(values, 15.0) == 0


def test_the_facts_of_a_foot_are_those_it_was_made_with():
    series = moving(4, stand=500, bias=(0.01, -0.02, 0.03))
    quality = quality_of(series)
    assert quality.rate_hz == pytest.approx(RATE_HZ)
    assert quality.duration_s == pytest.approx(11.99)
    assert quality.jitter_s == 0.0
    assert quality.stand.start_s == 0.0
    assert quality.stand.end_s == pytest.approx(5.0, abs=0.75)
    assert quality.stand.gravity == pytest.approx(GRAVITY, abs=0.01)
    assert np.allclose(quality.stand.angular_rate, [0.01, -0.02, 0.03], atol=1e-3)


def test_jitter_is_the_spread_of_the_intervals():
    series = moving(5)
    late = np.random.default_rng(0).integers(0, 2_000_000, len(series))
    quality = quality_of(replace(series, stamp_ns=series.stamp_ns + late))
    assert 1e-3 < quality.jitter_s < 2.1e-3


def test_lost_samples_are_no_jitter_and_times_of_arrival_are():
    rng = np.random.default_rng(4)
    whole = moving(1)
    lossy = whole[rng.random(len(whole)) > 0.12]
    late = replace(whole, stamp_ns=whole.stamp_ns + rng.exponential(5e6, len(whole)).astype(int))
    for series, jitters in ((whole, False), (lossy, False), (late, True)):
        assert ("jitter" in named(of(series))) is jitters


@pytest.mark.parametrize(
    ("times", "kind", "words"),
    [
        (57.3, "rate_unit", "57 times too small"),
        (30.0, "rate_misfit", "contradict each other"),
        (10.0, "rate_misfit", "contradict each other"),
        (3.0, "rate_scale", "too small against the specific force"),
    ],
)
def test_a_gyro_that_does_not_fit_the_accelerometer_is_named(times, kind, words):
    feet = {}
    for foot, seed in (("left", 1), ("right", 2)):
        good = moving(seed)
        feet[foot] = replace(good, angular_rate=good.angular_rate / times)
    found = [f for f in findings_of(Recording(**feet)) if f.kind == kind]
    assert [f.about for f in found] == ["left", "right"]
    assert all(words in f.sentence for f in found)


def test_a_scale_of_the_rate_that_the_time_explains_names_the_rate_of_sampling():
    slow = {
        foot: replace(series, stamp_ns=2 * series.stamp_ns)
        for foot, series in (("left", moving(1)), ("right", moving(2)))
    }
    found = [f for f in findings_of(Recording(**slow)) if f.kind is FindingKind.RATE_SCALE]
    seen = [float(f.remedy.split("come at ")[1].split(" Hz and not at 50 Hz")[0]) for f in found]
    assert seen == pytest.approx([100.0, 100.0], rel=0.1)


@pytest.mark.parametrize("speed", [1.2, 2.0])
def test_a_brisk_walk_without_any_stand_has_its_unit_from_its_stances(speed):
    made = simulate(WalkConfig(route="straight", rate=60.0, speed=speed, standing=2.0), seed=3)
    good = Recording(made.left[300:1500], made.right[300:1500])
    assert quality_of(good.left).stand is None
    assert "force_unit" not in named(good)
    in_g = Recording(scaled(good.left, force=1 / GRAVITY), scaled(good.right, force=1 / GRAVITY))
    found = [f.text for f in findings_of(in_g) if f.kind is FindingKind.FORCE_UNIT]
    assert len(found) == 2
    assert all("in its quiet moments, so it is in g" in text for text in found)


def test_a_foot_that_only_stands_may_turn_slowly():
    still = moving(1, count=600, stand=600)
    kinds = {f.kind for f in findings_of(Recording(left=still, right=moving(2)))}
    assert "rate_unit" not in kinds
