import itertools
import math
from functools import cache

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from own_time import put_in_place
from rclpy.parameter import Parameter
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

from dualfoot_ros.core import (
    DualFootTracker,
    ImuPair,
    TrackerConfig,
    quaternion_matrix,
    yaw_quaternion,
)
from dualfoot_ros.core.results.events import EventKind
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.inputs.initial_pose import InitialPose
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.messages import pose_of, to_ns
from dualfoot_ros.recording import read_bag
from dualfoot_ros.settings.nodes import InputConfig
from dualfoot_ros.timing import align

from .samples import STANDING, STEP_NS, imu, status_values

pytestmark = pytest.mark.usefixtures("clock")  # no input falls silent while the machine is busy
FEET = ("left", "right")
STAND_S = 2.5  # half a second more than the alignment needs
STAND_NS = round(STAND_S * 1e9)
QUICK = {"engine": "compiled", "reports.period": 0.1, "input.depth": 20_000}


class Walker:
    """Sends samples to a fusion node and collects what it publishes."""

    def __init__(self, bench, values=None):
        self.bench = bench
        self.fusion = bench.add(FusionNode, {**QUICK, **(values or {})})
        self.probe = bench.plain()
        self.sent = 0
        external = (values or {}).get("sync") == "external"
        topic = "imu/data_sync" if external else "imu/data_raw"
        deep = qos.result(20_000)
        self._out = {
            f: self.probe.create_publisher(Imu, f"{f}/{topic}", qos.sensor(20_000)) for f in FEET
        }
        self.got = {name: [] for name in ("left", "right", "person", "paths", "reports")}
        self._listen(Odometry, "left/odometry", "left", deep)
        self._listen(Odometry, "right/odometry", "right", deep)
        self._listen(Odometry, "odometry", "person", deep)
        self._listen(Path, "left/path", "paths", qos.latched(100))
        self._listen(DiagnosticArray, "/diagnostics", "reports", deep)
        bench.until(self._connected, "discovery")

    def _listen(self, kind, topic, name, profile):
        self.probe.create_subscription(kind, topic, self.got[name].append, profile)

    def _connected(self):
        topics = ("left/odometry", "right/odometry", "odometry", "left/path", "/diagnostics")
        return all(p.get_subscription_count() for p in self._out.values()) and all(
            self.probe.count_publishers(topic) for topic in topics
        )

    def send(self, foot, stamp_ns, values=STANDING):
        self._out[foot].publish(imu(stamp_ns, values))
        self.sent += 1
        if self.sent % 200 == 0:
            self.taken()

    def taken(self):
        """Wait until fusion has taken everything that was sent."""
        self.bench.until(
            lambda: self.fusion.streams.received == self.sent,
            "samples",
        )

    def stand(self, seconds, start_ns=10**12):
        for k in range(round(seconds * 1e9 / STEP_NS)):
            for foot in FEET:
                self.send(foot, start_ns + k * STEP_NS)
        self.taken()

    def walk(self, left, right):
        values = {}
        for foot, each in (("left", left), ("right", right)):
            rows = np.hstack([each.specific_force, each.angular_rate])
            values[foot] = list(zip(each.stamp_ns.tolist(), rows, strict=True))
        for pair in zip(values["left"], values["right"], strict=True):
            for foot, (stamp_ns, row) in zip(FEET, pair, strict=True):
                self.send(foot, stamp_ns, row)
        self.taken()

    def published(self):
        """Wait for everything that was published to have arrived."""
        count = self.fusion.outputs.published
        self.bench.until(
            lambda: all(len(self.got[n]) == count for n in ("left", "right", "person")), "odometry"
        )
        return self.got

    def report(self, condition):
        """Wait for a diagnostic report of which ``condition`` holds, and return it."""
        self.got["reports"].clear()
        mine = "fusion"

        def found():
            reports = [r for r in self.got["reports"] if r.status[0].name == mine]
            return [r for r in reports if condition(r)]

        self.bench.until(found, "a report")
        return found()[0]


@pytest.fixture(scope="module")
def pairs(walk_bag):
    """Return the first 14 s of the walk on one grid."""
    recording = read_bag(walk_bag)
    left, right = align(recording.left, recording.right)
    return left[:840], right[:840]


@pytest.fixture(scope="module")
def walked(passing_bench, pairs):
    """Return a function that gives what is published of the walk with certain parameters."""

    @cache
    def run(**values):
        with pytest.MonkeyPatch.context() as patch, passing_bench() as bench:
            put_in_place(patch)
            walker = Walker(bench, {"frames.odom": "map", **values})
            walker.walk(*pairs)
            return walker.published()

    return run


@pytest.mark.parametrize("values", [{}, {"sync": "external"}], ids=["internal", "external"])
def test_what_is_published_is_what_the_tracker_says_to_the_bit(walked, pairs, values):
    got = walked(**values)
    tracker = DualFootTracker(TrackerConfig(), engine="compiled")
    k = 0
    for stamp_ns, row in zip(pairs[0].stamp_ns.tolist(), stack_pairs(*pairs), strict=True):
        update = tracker.add(ImuPair(stamp_ns, row))
        if update.left is None:
            continue
        for foot, estimate in (("left", update.left), ("right", update.right)):
            message = got[foot][k]
            position, quaternion = pose_of(message.pose.pose)
            assert to_ns(message.header.stamp) == stamp_ns
            np.testing.assert_array_equal(position, estimate.position)
            np.testing.assert_array_equal(quaternion, estimate.quaternion)
            covariance = message.pose.covariance.reshape(6, 6)
            np.testing.assert_array_equal(covariance, estimate.pose_covariance())
        k += 1
    assert k == len(got["left"]) > 100


def test_odometry_has_frames_increasing_stamps_and_full_covariances(walked):
    got = walked()
    children = {"left": "left_foot", "right": "right_foot", "person": "base_footprint"}
    for name, child in children.items():
        assert {(m.header.frame_id, m.child_frame_id) for m in got[name]} == {("map", child)}
        stamps = np.array([to_ns(m.header.stamp) for m in got[name]])
        assert (np.diff(stamps) > 0).all()
        for message in got[name][::50]:
            for covariance in (message.pose.covariance, message.twist.covariance):
                matrix = covariance.reshape(6, 6)
                np.testing.assert_allclose(matrix, matrix.T, atol=1e-12)
                assert np.linalg.eigvalsh(matrix).min() > -1e-9
                assert (np.diag(matrix)[:3] > 0.0).any()


def test_the_twist_is_the_change_of_the_pose_in_the_child_frame(walked):
    messages = walked()["left"]
    position = np.array([pose_of(m.pose.pose)[0] for m in messages])
    seconds = np.array([to_ns(m.header.stamp) for m in messages]) * 1e-9
    change = np.gradient(position, seconds, axis=0)
    velocity = np.array(
        [
            quaternion_matrix(pose_of(m.pose.pose)[1])
            @ [m.twist.twist.linear.x, m.twist.twist.linear.y, m.twist.twist.linear.z]
            for m in messages
        ]
    )
    swings = np.linalg.norm(velocity, axis=1) > 1.0
    assert swings.sum() > 50
    assert np.median(np.linalg.norm(change - velocity, axis=1)[swings]) < 0.1


def test_the_person_is_midway_between_the_feet_on_the_floor(walked):
    got = walked()
    left, right, person = (
        np.array([pose_of(m.pose.pose)[0] for m in got[n]]) for n in ("left", "right", "person")
    )
    np.testing.assert_allclose(person[:, :2], 0.5 * (left + right)[:, :2], atol=1e-12)
    assert person[0, 2] == pytest.approx(-TrackerConfig().zupt.lever_arm, abs=0.005)
    assert np.mean(person[:, 2] < np.minimum(left, right)[:, 2]) > 0.99
    assert all(abs(m.pose.pose.orientation.x) < 1e-12 for m in got["person"])


def test_a_path_has_a_pose_for_each_stance_and_comes_at_most_once_a_second(walked, pairs):
    paths = walked()["paths"]
    stamps = np.array([to_ns(path.header.stamp) for path in paths])
    assert (np.diff(stamps) >= 10**9).all()
    track = DualFootTracker(TrackerConfig()).run(*pairs)
    ends = track.of_kind(EventKind.STANCE_END, "left")
    assert len(paths[-1].poses) == sum(e.detected_ns <= stamps[-1] for e in ends) + 1
    steps = np.diff([p.pose.position.x for p in paths[-1].poses])
    assert (steps > -0.2).all() and steps.sum() > 3.0


def test_bad_samples_never_stop_the_node_and_are_counted(bench):
    walker = Walker(bench)
    walker.stand(1.0)
    before = walker.fusion.streams.aligner.counters["pairs"]
    start_ns = 10**12 + 10**9
    garbage = [[math.nan] * 6, [math.inf] * 6, [1e300] * 6, [-1e9] * 6, [0.0] * 6]
    for k, values in enumerate(garbage):
        walker.send("left", start_ns + k * STEP_NS, values)
        walker.send("right", start_ns + k * STEP_NS, values)
    walker.send("left", 0)
    walker.send("left", start_ns + 4 * STEP_NS)
    walker.taken()
    walker.stand(4.0, start_ns + 5 * STEP_NS)
    aligner, tracker = walker.fusion.streams.aligner.counters, walker.fusion.tracker.counters
    assert aligner["left_not_finite"] == 3 and aligner["right_not_finite"] == 3
    assert aligner["left_out_of_order"] == 1 and aligner["left_duplicate"] == 1
    assert tracker["out_of_range"] == 2 + 2  # and what is filled on the line towards them
    assert aligner["pairs"] > before + 350
    values = status_values(walker.report(lambda r: "aligner left_not_finite" in str(r)))
    assert values["aligner left_not_finite"] == "3" and values["tracker out_of_range"] == "4"
    assert len(walker.published()["left"]) > 0


def test_a_bag_that_starts_again_resets_the_filter(bench):
    walker = Walker(bench)
    walker.stand(STAND_S)
    assert walker.fusion.tracker.counters["resets"] == 0
    walker.stand(STAND_S)
    assert walker.fusion.tracker.counters["resets"] == 1
    stamps = [to_ns(m.header.stamp) for m in walker.published()["left"]]
    assert sum(b <= a for a, b in itertools.pairwise(stamps)) == 1


@pytest.mark.parametrize(
    ("first_s", "level", "words"),
    [
        (20.0, DiagnosticStatus.WARN, "but no sample yet"),
        (0.5, DiagnosticStatus.ERROR, "but no sample came for"),
    ],
    ids=["at first", "later"],
)
def test_one_foot_only_is_said_in_the_diagnostics(bench, clock, first_s, level, words):
    walker = Walker(bench, {"input.silence": 1.0, "input.first": first_s})
    right = walker.fusion.streams.inputs["right"]
    clock.move_on(1.5)
    bench.until(lambda: right.complaint(InputConfig(silence=1.0)), "silence of the right foot")
    for k in range(50):
        walker.send("left", k * STEP_NS)
    walker.taken()
    report = walker.report(lambda r: "right/imu/data_raw" in r.status[0].message)
    assert report.status[0].level == level
    assert f"has 1 publisher(s) {words}" in report.status[0].message


def test_units_that_are_not_si_are_said(bench):
    walker = Walker(bench)
    for k in range(300):
        for foot in FEET:
            walker.send(foot, k * STEP_NS, STANDING / 9.80665)
    walker.taken()
    report = walker.report(lambda r: "looks like g" in r.status[0].message)
    assert report.status[0].level == DiagnosticStatus.WARN


def test_diagnostics_tell_phase_engine_method_and_counters(bench):
    walker = Walker(bench, {"method": "zupt"})
    walker.stand(STAND_S)
    report = walker.report(lambda r: status_values(r)["aligner pairs"] == "250")
    values = status_values(report)
    assert (values["phase"], values["engine"], values["method"]) == (
        "standing",
        "compiled",
        "zupt",
    )
    assert values["left stance"] == "True"
    assert float(values["NIS ratio of ZUPT"]) >= 0.0 and "lag (s)" in values


def test_diagnostics_tell_the_spacing_that_is_being_learnt(bench):
    walker = Walker(bench, {"method": "spacing_vector"})
    walker.stand(STAND_S)
    report = walker.report(lambda r: status_values(r)["phase"] == "standing")
    values = status_values(report)
    assert 0.0 < float(values["spacing std (m)"]) < float(values["spacing of the feet (m)"])


def test_motion_during_the_alignment_is_said(bench):
    walker = Walker(bench)
    shaking = np.random.default_rng(1).normal(0.0, 2.0, (300, 6)) + STANDING
    for k, values in enumerate(shaking):
        for foot in FEET:
            walker.send(foot, k * STEP_NS, values)
    walker.taken()
    report = walker.report(lambda r: "stand still" in r.status[0].message)
    assert report.status[0].level == DiagnosticStatus.WARN
    assert walker.fusion.outputs.published == 0


def test_the_service_resets(bench):
    walker = Walker(bench)
    walker.stand(STAND_S)
    client = walker.probe.create_client(Trigger, "fusion/reset")
    bench.until(client.service_is_ready, "the service")
    answer = client.call_async(Trigger.Request())
    bench.until(answer.done, "the answer")
    assert answer.result().success and "stand still" in answer.result().message
    assert walker.fusion.tracker.counters["resets"] == 1
    assert walker.fusion.tracker.phase == "aligning"


def pose(x, y, yaw, frame_id="odom"):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame_id
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    q = yaw_quaternion(yaw)
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = float(q[2]), float(q[3])
    return message


KNOWN = pose(10.0, -5.0, 1.0)
KNOWN.pose.covariance[0] = KNOWN.pose.covariance[7] = 4.0
KNOWN.pose.covariance[35] = 0.04


def test_initialpose_moves_and_turns_the_person_as_well_as_it_says(bench, monkeypatch):
    taken, take = [], InitialPose.receive
    monkeypatch.setattr(
        InitialPose, "receive", lambda self, message: taken.append(take(self, message))
    )
    walker = Walker(bench)
    publisher = walker.probe.create_publisher(PoseWithCovarianceStamped, "initialpose", 1)
    bench.until(publisher.get_subscription_count, "discovery")
    walker.stand(STAND_S)
    for number, each in enumerate(
        (pose(float("nan"), 0.0, 0.0), pose(50.0, 50.0, 0.0, "elsewhere"), KNOWN)
    ):
        assert walker.fusion.tracker._stream.undisturbed is not None  # no pose waits
        publisher.publish(each)
        bench.until(lambda n=number: len(taken) > n, "the pose")
    walker.stand(1.0, 10**12 + STAND_NS)
    person = walker.published()["person"][-1]
    position, quaternion = pose_of(person.pose.pose)
    np.testing.assert_allclose(position[:2], [10.0, -5.0], atol=0.02)
    assert position[2] == pytest.approx(0.0, abs=0.01)  # the floor, not the sensors
    assert 2 * math.atan2(quaternion[2], quaternion[3]) == pytest.approx(1.0, abs=0.02)
    covariance = person.pose.covariance.reshape(6, 6)
    assert covariance[0, 0] == pytest.approx(4.0, rel=0.01)


def test_a_prefix_gives_every_frame_a_name_of_its_own(bench):
    walker = Walker(bench, {"frames.prefix": "anna/"})
    walker.stand(STAND_S)
    got = walker.published()
    assert {m.header.frame_id for name in ("left", "person") for m in got[name]} == {"anna/odom"}
    assert {m.child_frame_id for m in got["person"]} == {"anna/base_footprint"}


def test_thresholds_aids_and_spacing_change_while_it_runs_and_the_rest_says_why_not(bench):
    walker = Walker(bench)
    walker.stand(STAND_S)
    fusion = walker.fusion
    changes = {
        "stance.threshold": 9000.0,
        "aids.flat_floor": True,
        "spacing_vector.spacing": 0.2,
        "person.trust_limit": 5.0,
    }
    results = fusion.set_parameters([Parameter(name, value=v) for name, v in changes.items()])
    assert all(result.successful for result in results)
    assert fusion.tracker.config.stance.threshold == 9000.0
    assert fusion.tracker.spacing == (0.2, 0.0)
    assert fusion.outputs.person.trust.tracker.limit_m == 5.0
    refused = [Parameter("zupt.std", value=-1.0), Parameter("frames.odom", value="map")]
    assert not any(result.successful for result in fusion.set_parameters(refused))
    described = fusion.describe_parameter("frames.odom")
    assert "read-only: subscribers know the frames" in described.additional_constraints
    walker.stand(1.0, 10**12 + STAND_NS)
    assert walker.published()["person"]
