"""Inputs that know why they are silent, and the monitor that says so within seconds."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from rclpy.clock import Clock, ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible

from ...inspection import Finding, FindingKind, Key, Severity
from ...settings import InputConfig
from .status import Status

LOOK_EVERY = 0.25  # s
NEWEST = 10  # a message that waited for a tenth of what is allowed is new
REMEDY = (
    "give the process more of the machine: engine compiled, fewer nodes in it, a lower rate of "
    "the sensors"
)


def silence(who: str, begun: bool, silent_s: float, config: InputConfig) -> Finding:
    """Return the finding about an input that could deliver and does not.

    One that has not begun is given time: samples are withheld while a clock is learnt.
    """
    if begun:
        text = f"{who} but was silent for {silent_s:.1f} s"
        return Finding(FindingKind.SILENT, Severity.ERROR, text)
    if silent_s < config.first:
        return Finding(FindingKind.NOT_BEGUN, Severity.WARNING, f"{who} but no sample yet")
    text = f"{who} but no sample came for {silent_s:.1f} s"
    return Finding(FindingKind.BEGINS_LATE, Severity.ERROR, text)


class WatchedInput:
    """A subscription that counts what arrives and what was lost, and knows why nothing comes.

    ``lost`` counts the holes in the publisher's own numbering, which no queue hides.
    ``arrival_ns`` is when the newest message came from the network, whatever time it then spent
    in the queue; with ``use_sim_time`` it is the simulated time at which it is taken out.
    ``callback`` gets each message, as its bytes where ``raw``.
    ``remedy`` is that of the finding where a publisher is there and silent.

    A message that has waited in the queue for more than ``latency_s`` (0: any time) is dropped,
    and so are those behind it down to the newest; ``dropped`` counts them.
    """

    def __init__(
        self,
        node: Node,
        message_type: Any,
        topic: str,
        callback: Callable[[Any], None],
        profile: QoSProfile,
        *,
        remedy: str = "",
        latency_s: float = 0.0,
        raw: bool = False,
    ) -> None:
        self.received = self.lost = self.dropped = 0
        self._latency_ns, self._dropping = round(latency_s * 1e9), False
        self._number: int | None = None
        self.arrival_ns = 0
        self.last_s = self._free_s = time.monotonic()
        self._node, self._callback, self._profile, self._remedy = node, callback, profile, remedy
        self._type, self._type_name, self._raw = message_type, _type_name(message_type), raw
        self._subscription = self._subscribe(topic)

    def _subscribe(self, topic: str) -> Any:
        # rclpy's own warning of an incompatible QoS is left out: `_find_fault` says more.
        silent = SubscriptionEventCallbacks(use_default_callbacks=False)
        how = {"event_callbacks": silent, "raw": self._raw}
        return self._node.create_subscription(
            self._type, topic, self._receive, self._profile, **how
        )

    def move(self, topic: str) -> None:
        """Subscribe to another topic instead; its publisher numbers its messages anew."""
        self._node.destroy_subscription(self._subscription)
        self._subscription, self._number = self._subscribe(topic), None
        self.last_s = self._free_s = time.monotonic()

    @property
    def topic(self) -> str:
        """Full name of the topic."""
        return str(self._subscription.topic_name)

    def _receive(self, message: Any, info: dict[str, Any]) -> None:
        self.received += 1
        self.last_s = time.monotonic()
        self.arrival_ns = self._read_arrival(info)
        number = info.get("publication_sequence_number")
        if number is not None:
            if self._number is not None and number > self._number:
                self.lost += number - self._number - 1
            self._number = number
        if self._is_too_old(info):
            self.dropped += 1
        else:
            self._callback(message)

    def _is_too_old(self, info: dict[str, Any]) -> bool:
        """Return whether a message waited too long, or stands behind one that did."""
        received_ns = int(info.get("received_timestamp") or 0)
        if not self._latency_ns or received_ns <= 0:
            return False
        waited_ns = time.time_ns() - received_ns
        limit_ns = self._latency_ns // NEWEST if self._dropping else self._latency_ns
        self._dropping = waited_ns > limit_ns
        return self._dropping

    def _read_arrival(self, info: dict[str, Any]) -> int:
        received_ns = int(info.get("received_timestamp") or 0)
        clock = self._node.get_clock()
        if received_ns <= 0 or clock.ros_time_is_active:
            return int(clock.now().nanoseconds)
        return received_ns

    def complaint(self, config: InputConfig) -> Finding | None:
        """Return why nothing came for ``config.silence``, or None when something did."""
        now_s = time.monotonic()
        if now_s - self.last_s < config.silence:
            return None
        fault = self._find_fault()
        if fault is not None:
            self._free_s = now_s  # a first message is waited for from here on only
            return fault
        begun = self.received > 0
        since_s = self.last_s if begun else self._free_s
        count = self._node.count_publishers(self.topic)
        who = f"topic '{self.topic}' has {count} publisher(s)"
        finding = silence(who, begun, now_s - since_s, config)
        return finding._replace(remedy=self._remedy, about=self.topic)

    def _find_fault(self) -> Finding | None:
        """Return why nothing can come, or None when something could.

        Asked of the publishers that are there now: one that has gone is no fault of the next.
        """
        publishers = self._node.get_publishers_info_by_topic(self.topic)
        if not publishers:
            return self._fault(FindingKind.NO_PUBLISHER, "has no publisher")
        typed = [p for p in publishers if p.topic_type == self._type_name]
        if not typed:
            types = ", ".join(sorted({p.topic_type for p in publishers}))
            text = f"is published as {types}; expected is {self._type_name}"
            return self._fault(FindingKind.WRONG_TYPE, text)
        misfits = [_find_misfit(p.qos_profile, self._profile) for p in typed]
        if None in misfits:
            return None
        text = f"has a publisher whose QoS does not fit ({misfits[0]}), so nothing arrives"
        return self._fault(FindingKind.QOS_MISFIT, text)

    def _fault(self, kind: FindingKind, text: str) -> Finding:
        text = f"topic '{self.topic}' {text}"
        return Finding(kind, Severity.ERROR, text, about=self.topic)


class Watched(Protocol):
    """An input that a node waits for: one topic, or several of which one is enough."""

    @property
    def topic(self) -> str:
        """Full name of the topic."""

    @property
    def received(self) -> int:
        """Messages that have arrived."""

    @property
    def lost(self) -> int:
        """Messages that have not."""

    def complaint(self, config: InputConfig) -> Finding | None:
        """Return why nothing came for ``config.silence``, or None when something did."""


class InputMonitor:
    """Monitor of a node's inputs by the wall clock, which logs each new reason of silence once."""

    def __init__(self, node: Node, inputs: Sequence[Watched], config: InputConfig) -> None:
        self._node, self._inputs, self._config = node, inputs, config
        self._logged: dict[str, Key | None] = {}
        self._lost: dict[str, int] = {}
        self._dropped: dict[str, int] = {}
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(LOOK_EVERY, self.look, clock=steady)

    def describe(self, status: Status) -> None:
        """Add what is missing, and how much has arrived, to a status."""
        for watched in self._inputs:
            topic = watched.topic
            status.values[f"received {topic}"] = watched.received
            status.values[f"lost {topic}"] = watched.lost
            complaint = watched.complaint(self._config)
            if complaint is not None:
                status.note(complaint)
            elif watched.lost > self._lost.get(topic, 0):
                text = f"samples on '{topic}' are lost before they arrive"
                kind = FindingKind.LOST_MESSAGES
                status.note(Finding(kind, Severity.WARNING, text, about=topic))
            self._lost[topic] = watched.lost
            if isinstance(watched, WatchedInput):
                self._describe_dropped(watched, status)

    def _describe_dropped(self, watched: WatchedInput, status: Status) -> None:
        """Add how many samples were dropped as the process is too slow for them."""
        status.values[f"dropped {watched.topic}"] = watched.dropped
        new = watched.dropped - self._dropped.get(watched.topic, 0)
        self._dropped[watched.topic] = watched.dropped
        if new > 0:
            text = (
                f"{new} samples on '{watched.topic}' waited for this process for more than "
                f"{self._config.latency:g} s and were dropped down to the newest"
            )
            kind = FindingKind.FALLING_BEHIND
            status.note(Finding(kind, Severity.WARNING, text, REMEDY, watched.topic))

    def look(self) -> None:
        """Log the inputs that have fallen silent, or deliver again, since the last look."""
        for watched in self._inputs:
            complaint = watched.complaint(self._config)
            key = None if complaint is None else complaint.key
            if key == self._logged.get(watched.topic):
                continue
            self._logged[watched.topic] = key
            if complaint is not None:
                self._node.get_logger().warning(complaint.sentence)
            else:
                self._node.get_logger().info(f"topic '{watched.topic}' delivers")


def _find_misfit(offered: QoSProfile, asked: QoSProfile) -> str | None:
    """Return in words why a publisher does not fit, or None when it does."""
    compatibility, reason = qos_check_compatible(offered, asked)
    if compatibility != QoSCompatibility.ERROR:
        return None
    return str(reason).lower().replace("error: ", "").rstrip(";").replace(";", ", ")


def _type_name(message_type: Any) -> str:
    package = message_type.__module__.split(".")[0]
    return f"{package}/msg/{message_type.__name__}"
