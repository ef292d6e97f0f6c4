"""What fusion publishes of the person: odometry, smoothed odometry, and how far to trust it."""

from __future__ import annotations

import math

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry
from rclpy.node import Node

from ...core import (
    EventKind,
    PersonEstimate,
    PersonTracker,
    SmoothedPerson,
    Smoother,
    StepTracker,
    Trust,
    TrustTracker,
    Update,
)
from ...inspection import lost_heading
from ...settings import FrameConfig, PathConfig, PersonConfig
from ..ros import qos
from ..ros.cdr_odometry import OdometryBytes
from ..ros.diagnostics import key_values
from ..ros.messages import fill_person, fill_smoothed
from ..ros.status import OK, WARN, Status
from .rviz_markers import Markers
from .step_outputs import PersonPath, step_message

TRUST_EVERY_NS = 1_000_000_000


class PersonOutputs:
    """Publishers of the person between the feet."""

    def __init__(
        self, node: Node, frames: FrameConfig, config: PersonConfig, path: PathConfig
    ) -> None:
        """Publish on topics of ``node``."""
        self._steps = StepTracker()
        self._step = node.create_publisher(DiagnosticArray, "steps", qos.result())
        self._path = PersonPath(node, frames.odom, path)
        self._markers = Markers(node, frames.odom)
        self._person = PersonTracker()
        self._smoother = Smoother(config.window, config.smoothed_rate)
        self.trust = TrustOutput(node, config.trust_limit)
        self.message = OdometryBytes(frames.odom, frames.pedestrian)
        self._smoothed = OdometryBytes(frames.odom, frames.pedestrian)
        self._exact = node.create_publisher(Odometry, "odometry", qos.result())
        self._smooth = node.create_publisher(Odometry, "odometry/smoothed", qos.result())

    def clear(self) -> None:
        """Forget everything: the track starts anew."""
        self._person.clear()
        self._smoother.clear()
        self._steps.clear()
        self._path.clear()
        self._markers.clear()
        self.trust.clear()

    @property
    def swing_turn(self) -> float:
        """By how much the feet in stance are ahead of the person's heading now, rad."""
        return self._person.swing_turn

    def publish(self, update: Update) -> None:
        """Publish the person of an update that has an estimate."""
        person = self._person.add(update)
        if person is None:
            return
        fill_person(self.message, person)
        self._exact.publish(self.message.data())
        smoothed = self._follow(update, person)
        if smoothed is not None:
            fill_smoothed(self._smoothed, smoothed)
            self._smooth.publish(self._smoothed.data())

    def catch_up(self, update: Update) -> None:
        """Take an update whose time is past: into the steps and the path, without odometry."""
        person = self._person.add(update)
        if person is not None:
            self._follow(update, person)

    def _follow(self, update: Update, person: PersonEstimate) -> SmoothedPerson | None:
        """Take the person into all that remembers it; return the smoothed one if it is due."""
        turns = [e.turn for e in update.announced if e.kind is EventKind.HEADING]
        if any(turn.joint for turn in turns):
            self.trust.clear()
        self.trust.add(person)
        self._publish_steps(update, person)
        return self._smoother.add(person, moved=bool(turns))

    def _publish_steps(self, update: Update, person: PersonEstimate) -> None:
        """Publish the steps that are sure by now, and what shows them."""
        steps = self._steps.add(update, person)
        for step in steps:
            self._step.publish(step_message(step))
        self._path.add(person, steps, update.announced)
        self._markers.add(update, person, steps)


class TrustOutput:
    """Publisher of how far the position can be trusted, latched and in the diagnostics."""

    def __init__(self, node: Node, limit_m: float) -> None:
        """Trust a position up to a 95 % radius of ``limit_m`` m."""
        self.tracker = TrustTracker(limit_m)
        self._publisher = node.create_publisher(DiagnosticStatus, "~/trust", qos.latched())
        self._due_ns: int | None = None

    def clear(self) -> None:
        """Forget everything: the track starts anew."""
        self.tracker.clear()
        self._due_ns = None

    def add(self, person: PersonEstimate) -> None:
        """Take the person once a second, and publish what the position is worth."""
        if self._due_ns is not None and person.stamp_ns < self._due_ns:
            return
        self._due_ns = person.stamp_ns + TRUST_EVERY_NS
        covariance = person.pose_covariance
        self.tracker.add(
            person.stamp_ns,
            person.position[:2],
            covariance[:2, :2],
            float(covariance[5, 5]),
            heading_known=person.heading_known,
        )
        trust = self.tracker.result()
        if trust is not None:
            self._publisher.publish(trust_message(trust))

    def describe(self, status: Status) -> None:
        """Add what the position is worth to a status."""
        trust = self.tracker.result()
        if trust is not None:
            status.values |= trust_values(trust)
            status.values["trust"] = trust_sentence(trust)
            if trust.heading_lost:
                status.note(lost_heading(trust.heading_std))


def trust_values(trust: Trust) -> dict[str, float | bool]:
    """Return the figures of ``trust`` by name."""
    return {
        "position radius 95 % (m)": trust.radius_m,
        "trust limit (m)": trust.limit_m,
        "way left (m)": trust.way_left_m,
        "time left (s)": trust.time_left_s,
        "heading known": trust.heading_known,
    }


def trust_sentence(trust: Trust) -> str:
    """Return in words what the position is worth."""
    radius = f"position within {trust.radius_m:.2g} m (95 %)"
    if trust.heading_lost:
        return f"{radius}; the heading is lost: give a pose, or use a heading aid"
    if not trust.trusted:
        return f"{radius}, beyond the limit of {trust.limit_m:g} m"
    if not trust.heading_known:
        return f"{radius}; the direction of the walk is not known yet"
    if not math.isfinite(trust.way_left_m):
        return f"{radius}, within {trust.limit_m:g} m for as long as can be foretold"
    if not math.isfinite(trust.time_left_s):
        return f"{radius}, within {trust.limit_m:g} m for {trust.way_left_m:.0f} m more of way"
    left = f"{trust.way_left_m:.0f} m or {trust.time_left_s:.0f} s more at this pace"
    return f"{radius}, within {trust.limit_m:g} m for {left}"


def trust_message(trust: Trust) -> DiagnosticStatus:
    """Return ``trust`` as a message: a warning once the radius is beyond the limit."""
    return DiagnosticStatus(
        level=OK if trust.trusted else WARN,
        name="trust",
        message=trust_sentence(trust),
        values=key_values(trust_values(trust)),
    )
