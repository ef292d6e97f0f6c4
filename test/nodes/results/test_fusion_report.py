"""The report of fusion: made of parts that describe themselves, and of the tracker's updates."""

from types import SimpleNamespace

import numpy as np
import pytest

from dualfoot_ros.core import (
    DualFootTracker,
    Event,
    EventKind,
    ImuPair,
    Refusal,
    TrackerConfig,
    Update,
)
from dualfoot_ros.core.results.context import Context
from dualfoot_ros.inspection import Finding, FindingKind, Severity
from dualfoot_ros.nodes.results.fusion_report import FusionReport
from dualfoot_ros.nodes.ros.diagnostics import OVER_S
from dualfoot_ros.nodes.ros.status import OK, WARN, Status
from dualfoot_ros.timing import Aligner

from ..samples import STANDING, STEP_NS

PAIR = np.concatenate([STANDING, STANDING])
FEET = ("left", "right")


class Log:
    """Keeps what is logged; its clock stands."""

    def __init__(self):
        self.warnings, self.infos = [], []
        self.warning, self.info = self.warnings.append, self.infos.append

    def now(self):
        return SimpleNamespace(nanoseconds=10**12)


class Bench:
    """A report with a tracker and an aligner of its own."""

    def __init__(self, parts=(), *, external=False):
        config = TrackerConfig.from_mapping({"alignment": {"duration": 0.5, "window": 0.1}})
        self.tracker = DualFootTracker(config, engine="compiled")
        self.aligner, self.log = Aligner(), Log()
        self.report = FusionReport(
            self.tracker, self.aligner, parts, self.log, self.log, external=external
        )

    def track(self, stamp_ns, values=PAIR):
        self.report.add(self.tracker.add(ImuPair(stamp_ns, values)))

    def status(self):
        status = Status()
        self.report.collect(status)
        return status

    def kinds(self):
        return [finding.kind for finding in self.status().findings]


@pytest.fixture
def fusion():
    return Bench()


def test_it_has_what_its_parts_describe():
    def describe(status):
        status.values["part"] = 7
        status.note(Finding(FindingKind.SILENT, Severity.WARNING, "the part is silent"))

    status = Bench([SimpleNamespace(describe=describe)]).status()
    assert status.values["part"] == 7
    assert (status.level, status.message) == (WARN, "the part is silent")


def test_each_reason_of_refusal_is_logged_once_in_words_with_its_counter(fusion):
    fusion.track(0)
    for k in range(5):
        fusion.track((k + 1) * STEP_NS, PAIR * np.nan)
        fusion.track((k + 1) * STEP_NS, PAIR + 1e6)
    first, second = fusion.log.warnings
    assert Refusal.NOT_FINITE.words in first and "tracker not_finite" in first
    assert Refusal.OUT_OF_RANGE.words in second


def test_refusals_are_a_warning_for_as_long_as_they_go_on(fusion):
    fusion.track(0)
    fusion.track(STEP_NS, PAIR * np.nan)
    fusion.aligner.push("left", 0, STANDING * np.nan)
    (finding,) = fusion.status().findings
    assert finding.kind is FindingKind.REFUSED_SAMPLES
    assert "tracker not_finite" in finding.text and "aligner left_not_finite" in finding.text
    assert fusion.status().level == OK


@pytest.mark.parametrize("reason", list(Refusal))
def test_a_counter_is_warned_of_if_its_reason_needs_it(fusion, reason):
    fusion.tracker.counters[reason] += 1
    own = {
        Refusal.STANCES_WITHOUT_PRESSURE: FindingKind.NO_PRESSURE,
        Refusal.STANCES_WITHOUT_FIELD: FindingKind.NO_FIELD,
    }
    refused = [FindingKind.REFUSED_SAMPLES] if reason.needs_warning else []
    assert fusion.kinds() == [*refused, *([own[reason]] if reason in own else [])]


@pytest.mark.parametrize("external", [False, True])
def test_interpolated_pairs_are_a_warning_where_another_node_makes_the_pairs(external):
    fusion = Bench(external=external)
    for k in range(20):
        fusion.aligner.push("left", k * STEP_NS, STANDING)
        fusion.aligner.push("right", k * STEP_NS + STEP_NS // 2, STANDING)
    assert fusion.kinds() == ([FindingKind.STAMPS_NOT_SHARED] if external else [])


def test_two_seconds_of_walking_without_a_stance_are_a_warning_for_each_foot(fusion):
    fusion.report.add(Update(10**12, Context("standing")))
    for second in range(3):
        fusion.report.add(Update(10**12 + second * 10**9, Context("walking")))
    assert fusion.kinds() == []
    fusion.report.add(Update(10**12 + 3 * 10**9, Context("walking")))
    assert fusion.kinds() == [FindingKind.NO_STANCE] * 2


def test_values_tell_phase_and_stances_once_the_feet_have_stood(fusion):
    for k in range(200):
        fusion.track(10**12 + k * STEP_NS, PAIR + 1e-3 * np.sin(k + np.arange(12)))
    values = fusion.status().values
    assert values["phase"] == "standing" and all(values[f"{foot} stance"] for foot in FEET)
    assert values["tracker pairs"] == 200 and values["lag (s)"] == pytest.approx(-1.99)
    assert any("aligned of both" in line for line in fusion.log.infos)


def test_a_rate_that_is_not_that_of_the_start_is_a_warning_with_both_figures(fusion):
    for k in range(300):
        fusion.track(10**12 + k * STEP_NS, PAIR + 1e-3 * np.sin(k + np.arange(12)))
    assert fusion.status().values["rate used (Hz)"] == pytest.approx(100.0)
    assert FindingKind.RATE_USED not in fusion.kinds()
    start_ns = 10**12 + 300 * STEP_NS
    for k in range(600):
        fusion.track(start_ns + k * STEP_NS // 2, PAIR + 1e-3 * np.sin(k + np.arange(12)))
    (finding,) = fusion.status().of_kind(FindingKind.RATE_USED)
    assert "100.0 Hz" in finding.text and "200.0 Hz" in finding.text


def test_a_foot_that_was_lost_is_a_warning_for_ten_seconds(fusion):
    second = 10**9
    lost = Event(EventKind.LOST, 10**12, "left", 10**12 + second)
    fusion.report.add(Update(10**12 + second, Context("standing", events=(lost,))))
    (finding,) = fusion.status().of_kind(FindingKind.LOST_FOOT)
    assert finding.about == "left"
    fusion.report.add(Update(10**12 + 10 * second, Context("standing")))
    assert fusion.kinds() == [FindingKind.LOST_FOOT]
    fusion.report.add(Update(10**12 + 11 * second, Context("standing")))
    assert fusion.kinds() == []


def test_the_lag_behind_another_clock_is_not_given_as_a_number(fusion):
    fusion.track(10**12 - 2 * 10**9)
    assert fusion.status().values["lag (s)"] == pytest.approx(2.0)
    old = Bench()
    old.track(10**12 - 3600 * 10**9)
    assert "another clock" in old.status().values["lag (s)"]


def test_pairs_that_are_refused_are_logged_once_and_once_when_it_is_over(fusion, clock):
    fusion.track(STEP_NS)
    for _ in range(5):
        fusion.track(STEP_NS)  # the same stamp again
        clock.move_on(1.0)
        fusion.status()
    assert len(fusion.log.warnings) == 1 and not fusion.log.infos
    clock.move_on(OVER_S)
    fusion.status()
    fusion.status()
    words = Refusal.DUPLICATE.words
    assert fusion.log.infos == [f"over: pairs are refused: {words}"]
    fusion.track(STEP_NS)
    assert len(fusion.log.warnings) == 2
