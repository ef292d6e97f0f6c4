"""Samples of two topics become pairs: stamped, compared, and paired in this order."""

import math

import numpy as np
import pytest
from rclpy.node import Node

from dualfoot_ros.inspection import FindingKind
from dualfoot_ros.nodes.inputs.foot_streams import FootStreams
from dualfoot_ros.nodes.ros.declared_parameters import declare
from dualfoot_ros.nodes.ros.status import ERROR, Status
from dualfoot_ros.settings import node_specs
from dualfoot_ros.timing import StampConfig

from ..samples import STANDING, STEP_NS, imu_bytes

FEET = ("left", "right")


class Bench:
    """Streams of a node without a partner, whose samples the test hands over itself."""

    def __init__(self, bench, stamping=None, **values):
        node = bench.add(lambda **options: Node("streams", **options), values)
        self.read, self.pairs = [], []
        self.streams = FootStreams(
            node,
            "imu/data_raw",
            declare(node, node_specs("time_sync")),
            self._read_sample,
            self.pairs.append,
            stamping=stamping or StampConfig(),
        )

    def _read_sample(self, foot, message, stamp_ns):
        self.read.append((foot, stamp_ns))
        return message.values

    def feed(self, foot, *stamps, values=STANDING):
        for stamp_ns in stamps:
            self.streams.receive(foot, imu_bytes(stamp_ns, values))

    def status(self):
        status = Status()
        self.streams.describe(status)
        return status


@pytest.fixture
def feet(bench):
    return Bench(bench)


def test_equal_stamps_become_pairs_with_the_values_of_both_feet(feet):
    for k in range(3):
        feet.feed("left", k * STEP_NS, values=STANDING + k)
        feet.feed("right", k * STEP_NS, values=STANDING - k)
    assert [pair.stamp_ns for pair in feet.pairs] == [0, STEP_NS, 2 * STEP_NS]
    np.testing.assert_array_equal(feet.pairs[2].values, [*(STANDING + 2), *(STANDING - 2)])


def test_samples_are_read_with_the_stamp_that_they_are_paired_by(bench):
    feet = Bench(bench, StampConfig(right_offset=-2.0))
    feet.feed("left", 10**9)
    feet.feed("right", 3 * 10**9)
    assert feet.read == [("left", 10**9), ("right", 10**9)]
    assert [pair.stamp_ns for pair in feet.pairs] == [10**9]


def test_headers_that_are_times_of_arrival_are_evened_out_where_that_is_asked_for(bench):
    """What jitters is said with the figure; evened out, nothing is left to say."""
    late = np.random.default_rng(0).uniform(0, 12e6, (2, 1500)).astype(np.int64)
    found = {}
    for policy in ("header", "even"):
        feet = Bench(bench, StampConfig(left=policy, right=policy))
        for k in range(1500):
            for foot, delay in zip(FEET, late[:, k].tolist(), strict=True):
                feet.feed(foot, 10**18 + k * STEP_NS + delay)
        steps = np.diff([pair.stamp_ns for pair in feet.pairs[-500:]])
        found[policy] = list(feet.status().of_kind(FindingKind.JITTER)), np.std(steps)
    said, spread_ns = found["header"]
    assert {finding.about for finding in said} == set(FEET) and spread_ns > 2e6
    assert "ms, as times of arrival are" in said[0].text and "to even" in said[0].remedy
    said, spread_ns = found["even"]
    assert said == [] and spread_ns < 3e5


def test_a_sample_without_a_stamp_is_neither_read_nor_paired(feet):
    feet.feed("left", -1 << 30)
    assert feet.read == [] and feet.streams.stamper.counters["not_stamped"] == 1
    assert feet.streams.aligner.counters["left_accepted"] == 0


def test_a_sample_that_is_refused_makes_no_pair(feet):
    feet.feed("left", 0, values=STANDING * math.nan)
    feet.feed("right", 0)
    assert feet.pairs == [] and feet.streams.aligner.counters["left_not_finite"] == 1


def test_a_reset_forgets_what_waits_for_the_other_foot(feet):
    feet.feed("left", *range(0, 10 * STEP_NS, STEP_NS))
    feet.streams.reset()
    feet.feed("right", *range(0, 10 * STEP_NS, STEP_NS))
    assert feet.pairs == []


def test_the_report_has_inputs_clocks_and_stamps(bench):
    feet = Bench(bench, StampConfig(left="device"), **{"input.silence": 0.1})
    feet.feed("right", 10**9)
    silent = FindingKind.NO_PUBLISHER
    bench.until(lambda: len(list(feet.status().of_kind(silent))) == len(FEET), "silence")
    status = feet.status()
    assert status.level == ERROR
    assert {finding.about for finding in status.of_kind(silent)} == {
        "/left/imu/data_raw",
        "/right/imu/data_raw",
    }
    assert status.values["received /left/imu/data_raw"] == 0
    assert status.values["left clock"] == "empty" and status.values["not_stamped"] == 0
