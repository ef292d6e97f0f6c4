"""Subscriptions of the live page: what fusion publishes, put into the state that is shown."""

from __future__ import annotations

import json
import math
from collections import deque
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry, Path
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

from ...core import DEGREE, FEET, Event, EventKind, FloatArray, quaternion_yaw
from ...inspection import Finding
from ...settings import InputConfig
from ..results import event_messages
from ..ros import qos
from ..ros.messages import pose_of, to_ns
from ..ros.status import OK
from ..ros.watched_input import WatchedInput
from .live_state import HEIGHT, PERSON, LiveState
from .node_reports import NodeReports
from .trail import Place

LOOK_S = 0.5  # between two looks at what the nodes report, and at what is silent
DUE_NS = 50_000_000  # poses are taken so often at most, in time of the stamps
RECENT = 21  # poses, about a second: the pace of a step does not show
REMEDY = (
    "start fusion or bringup, in this namespace (--namespace) and with this ROS_DOMAIN_ID, or "
    "wait until the feet are aligned"
)
POSES = {"left": "left/odometry", "right": "right/odometry"}
PATHS = {PERSON: "path", "left": "left/path", "right": "right/path"}


class PageInputs:
    """Subscriptions of ``node``, which keep ``state`` up to date."""

    def __init__(self, node: Node, state: LiveState) -> None:
        self._state = state
        self.reports = NodeReports(node.get_namespace())
        self._start_ns: int | None = None
        self._newest_ns = 0
        self._seen_ns = dict.fromkeys((PERSON, *FEET), 0)
        self._seeded: set[str] = set()
        self._batteries: dict[str, float] = {}
        self._recent: deque[Place] = deque(maxlen=RECENT)
        self._odometry = WatchedInput(
            node, Odometry, "odometry", self._take_person, qos.result(10), remedy=REMEDY
        )
        self._inputs = [self._odometry, *self._subscribe(node)]
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(LOOK_S, self.look, clock=steady)

    def _subscribe(self, node: Node) -> list[Any]:
        take = node.create_subscription
        feet = [
            take(Odometry, POSES[f], partial(self._take_foot, f), qos.result(10)) for f in FEET
        ]
        paths = [
            take(Path, topic, partial(self._take_path, name), qos.latched())
            for name, topic in PATHS.items()
        ]
        batteries = [
            take(BatteryState, f"{f}/battery", partial(self._take_battery, f), qos.sensor(1))
            for f in FEET
        ]
        results = [
            take(DiagnosticArray, "steps", self._take_step, qos.result(100)),
            take(DiagnosticArray, "fusion/events", self._take_events, qos.latched(200)),
            take(DiagnosticStatus, "fusion/trust", self._take_trust, qos.latched()),
            take(DiagnosticArray, "/diagnostics", self.reports.take, qos.result(100)),
        ]
        return [*feet, *paths, *batteries, *results]

    # ---- poses
    def _take_person(self, message: Odometry) -> None:
        stamp_ns = to_ns(message.header.stamp)
        if not self._is_due(PERSON, stamp_ns):
            return
        place, heading = self._place(stamp_ns, message)
        self._state.add((PERSON, HEIGHT), place)
        self._recent.append(place)
        covariance = np.asarray(message.pose.covariance, dtype=np.float64).reshape(6, 6)
        speed = {"speed": _mean_speed(self._recent)}
        person = {**_pose(place, heading), **speed, **_uncertainty(covariance)}
        self._state.show(person=_finite(person))

    def _take_foot(self, foot: str, message: Odometry) -> None:
        stamp_ns = to_ns(message.header.stamp)
        if self._is_due(foot, stamp_ns):
            self._state.show(**{foot: _finite(_pose(*self._place(stamp_ns, message)))})

    def _is_due(self, name: str, stamp_ns: int) -> bool:
        """Return whether a pose is to be shown; a stamp that goes back begins a new walk."""
        if stamp_ns < self._newest_ns - DUE_NS * len(self._seen_ns):
            self.clear()
        self._newest_ns = max(self._newest_ns, stamp_ns)
        if stamp_ns - self._seen_ns[name] < DUE_NS:
            return False
        self._seen_ns[name] = stamp_ns
        return True

    def _place(self, stamp_ns: int, message: Odometry) -> tuple[Place, float]:
        position, quaternion = pose_of(message.pose.pose)
        return self._at(stamp_ns, position), quaternion_yaw(quaternion)

    def _at(self, stamp_ns: int, position: FloatArray) -> Place:
        return Place(self._seconds(stamp_ns), *position.tolist())

    def _seconds(self, stamp_ns: int) -> float:
        """Return the time since the first stamp of the page, s."""
        if self._start_ns is None:
            self._start_ns = stamp_ns
        return 1e-9 * (stamp_ns - self._start_ns)

    def clear(self) -> None:
        """Forget the walk: another one begins."""
        self._state.clear()
        self._state.show(person=None, step=None, **dict.fromkeys(FEET))
        self._start_ns, self._newest_ns = None, 0
        self._seen_ns = dict.fromkeys(self._seen_ns, 0)
        self._seeded.clear()
        self._recent.clear()

    # ---- what was before, and what changes it
    def _take_path(self, name: str, message: Path) -> None:
        """Take what was walked before the page began; after that the page follows by itself."""
        if name in self._seeded or not message.poses:
            return
        self._seeded.add(name)
        places = [
            self._at(to_ns(pose.header.stamp), pose_of(pose.pose)[0])
            for pose in message.poses[:-1]
        ]
        published = self._seconds(to_ns(message.header.stamp))
        self._state.seed((PERSON, HEIGHT) if name == PERSON else (name,), places, published)

    def _take_events(self, message: DiagnosticArray) -> None:
        for event in event_messages.from_message(message):
            if event.kind is EventKind.RESET and event.detected_ns >= self._newest_ns:
                self.clear()
            elif event.kind is EventKind.HEADING:
                self._turn(event)

    def _turn(self, event: Event) -> None:
        """Turn the trails; those of the person from before the heading was known are dropped."""
        announced = self._seconds(event.detected_ns)
        self._state.turn((event.foot,), announced, event.turn)
        if not event.turn.joint:
            self._state.turn((PERSON, HEIGHT), announced, None)
            self._recent.clear()
        elif event.foot == FEET[0]:
            self._state.turn((PERSON, HEIGHT), announced, event.turn)

    def _take_step(self, message: DiagnosticArray) -> None:
        for status in message.status:
            values = {pair.key: json.loads(pair.value) for pair in status.values}
            place = self._at(to_ns(message.header.stamp), np.array(values["place"]))
            foot, published = status.hardware_id, self._seconds(values["detected_ns"])
            self._state.add((foot,), place, published)
            shown = {key: values[key] for key in ("length", "width", "duration", "height")}
            self._state.show(step={"foot": foot, **shown})

    # ---- what is said
    def _take_trust(self, message: DiagnosticStatus) -> None:
        values = {pair.key: pair.value for pair in message.values}
        self._state.show(
            trust=_finite(
                {
                    "text": message.message,
                    "trusted": message.level == OK,
                    "radius": float(values["position radius 95 % (m)"]),
                    "limit": float(values["trust limit (m)"]),
                    "way_left": float(values["way left (m)"]),
                    "time_left": float(values["time left (s)"]),
                    "heading_known": values["heading known"] == str(True),
                }
            )
        )

    def _take_battery(self, foot: str, message: BatteryState) -> None:
        self._batteries[foot] = 100.0 * message.percentage

    def look(self) -> None:
        """Show what the nodes report, and say what is silent."""
        complaint = self._odometry.complaint(InputConfig())
        feet = {foot: self.reports.foot(foot) for foot in FEET}
        for foot, percent in self._batteries.items():
            feet[foot]["battery"] = percent
        number = partial(self.reports.number, "fusion")
        self._state.show(
            feet={foot: _finite(values) for foot, values in feet.items()},
            silent=None if complaint is None else _with_remedy(complaint).sentence,
            warnings=self.reports.warnings(),
            method=self.reports.value("fusion", "method"),
            phase=self.reports.value("fusion", "phase"),
            filter=_finite(
                {"pairs": number("pair rate (Hz)"), "nis": number("NIS ratio of ZUPT")}
            ),
        )


def _with_remedy(complaint: Finding) -> Finding:
    return complaint._replace(remedy=complaint.remedy or REMEDY)


def _pose(place: Place, heading: float) -> dict[str, float]:
    return {**place._asdict(), "heading": heading / DEGREE}


def _mean_speed(recent: Sequence[Place]) -> float:
    """Return the mean speed on the level, m/s."""
    first, last = recent[0], recent[-1]
    passed_s = last.t - first.t
    return math.dist(first[1:3], last[1:3]) / passed_s if passed_s > 0.0 else 0.0


def _uncertainty(covariance: FloatArray) -> dict[str, float]:
    """Return standard deviations (m, degrees), and the axes of that of the position."""
    variance, axes = np.linalg.eigh(covariance[:2, :2])
    minor, major = np.sqrt(np.maximum(variance, 0.0)).tolist()
    return {
        "major": major,
        "minor": minor,
        "angle": math.atan2(float(axes[1, 1]), float(axes[0, 1])) / DEGREE,
        "height_std": math.sqrt(max(0.0, float(covariance[2, 2]))),
        "heading_std": math.sqrt(max(0.0, float(covariance[5, 5]))) / DEGREE,
    }


def _finite(values: dict[str, Any]) -> dict[str, Any]:
    """Return values with None for every number that JSON cannot hold."""
    return {
        key: None if isinstance(value, float) and not math.isfinite(value) else value
        for key, value in values.items()
    }
