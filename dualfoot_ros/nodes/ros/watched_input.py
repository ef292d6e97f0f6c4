"""Says within seconds, and by name, why an input is silent."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol

from rclpy.clock import Clock, ClockType
from rclpy.event_handler import (
    PublisherEventCallbacks,
    SubscriptionEventCallbacks,
    UnsupportedEventTypeError,
)
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import (
    QoSCompatibility,
    QoSProfile,
    qos_check_compatible,
    qos_policy_name_from_kind,
)

from ...settings import Input as InputOptions
from .diagnostics import ERROR, WARN, Status

LOOK_EVERY = 0.25  # s


class Complaint(NamedTuple):
    """Why nothing comes, and how bad that is."""

    level: bytes
    message: str


def silence(who: str, begun: bool, silent_s: float, options: InputOptions) -> Complaint:
    """Return what to say of an input that could deliver and does not.

    One that has not begun is given time: samples are withheld while a clock is learnt.
    """
    if begun:
        return Complaint(ERROR, f"{who} but was silent for {silent_s:.1f} s")
    if silent_s < options.first:
        return Complaint(WARN, f"{who} but no sample yet")
    return Complaint(ERROR, f"{who} but no sample came for {silent_s:.1f} s")


class Input:
    """A subscription that counts what arrives and what was lost, and knows why nothing comes.

    ``lost`` counts the holes in the publisher's own numbering, which no queue hides.
    ``arrival_ns`` is when the newest message came from the network, whatever time it then spent
    in the queue; with ``use_sim_time`` it is the simulated time at which it is looked at.
    ``hint`` is added where a publisher is there and silent.
    """

    def __init__(
        self,
        node: Node,
        message_type: Any,
        topic: str,
        callback: Callable[[Any], None],
        profile: QoSProfile,
        hint: str = "",
    ) -> None:
        self.received = 0
        self.lost = 0
        self._number: int | None = None
        self.arrival_ns = 0
        self.last_s = self._free_s = time.monotonic()
        self._node, self._callback, self._profile, self._hint = node, callback, profile, hint
        self._type_name = _type_name(message_type)
        silent = SubscriptionEventCallbacks(use_default_callbacks=False)  # `_fault` says it all
        self._subscription = node.create_subscription(
            message_type, topic, self._receive, profile, event_callbacks=silent
        )

    @property
    def topic(self) -> str:
        """Full name of the topic."""
        return str(self._subscription.topic_name)

    def _receive(self, message: Any, info: dict[str, Any]) -> None:
        self.received += 1
        self.last_s = time.monotonic()
        self.arrival_ns = self._arrival_ns(info)
        number = info.get("publication_sequence_number")
        if number is not None:
            if self._number is not None and number > self._number:
                self.lost += number - self._number - 1
            self._number = number
        self._callback(message)

    def _arrival_ns(self, info: dict[str, Any]) -> int:
        received_ns = int(info.get("received_timestamp") or 0)
        clock = self._node.get_clock()
        if received_ns <= 0 or clock.ros_time_is_active:
            return int(clock.now().nanoseconds)
        return received_ns

    def complaint(self, options: InputOptions) -> Complaint | None:
        """Return why nothing came for ``options.silence``, or None when something did."""
        now_s = time.monotonic()
        if now_s - self.last_s < options.silence:
            return None
        fault = self._fault()
        if fault is not None:
            self._free_s = now_s  # a first message is waited for from here on only
            return Complaint(ERROR, fault)
        begun = self.received > 0
        since_s = self.last_s if begun else self._free_s
        count = self._node.count_publishers(self.topic)
        who = f"topic '{self.topic}' has {count} publisher(s)"
        level, message = silence(who, begun, now_s - since_s, options)
        return Complaint(level, message + self._hint)

    def _fault(self) -> str | None:
        """Return why nothing can come, or None when something could.

        Asked of the publishers that are there now: one that has gone is no fault of the next.
        """
        publishers = self._node.get_publishers_info_by_topic(self.topic)
        if not publishers:
            return f"topic '{self.topic}' has no publisher"
        typed = [p for p in publishers if p.topic_type == self._type_name]
        if not typed:
            types = ", ".join(sorted({p.topic_type for p in publishers}))
            return f"topic '{self.topic}' is published as {types}; expected is {self._type_name}"
        misfits = [_misfit(p.qos_profile, self._profile) for p in typed]
        if None not in misfits:
            return (
                f"topic '{self.topic}' has a publisher whose QoS does not fit "
                f"({misfits[0]}), so nothing arrives"
            )
        return None


class Watched(Protocol):
    """What a node waits for: one topic, or several of which one is enough."""

    @property
    def topic(self) -> str:
        """Full name of the topic."""

    @property
    def received(self) -> int:
        """Messages that have arrived."""

    @property
    def lost(self) -> int:
        """Messages that have not."""

    def complaint(self, options: InputOptions) -> Complaint | None:
        """Return why nothing came for ``options.silence``, or None when something did."""


class Watch:
    """Looks at the inputs of a node by the wall clock and warns once for each new complaint."""

    def __init__(self, node: Node, inputs: Sequence[Watched], options: InputOptions) -> None:
        self._node, self._inputs, self._options = node, inputs, options
        self._said: dict[str, str | None] = {}
        self._lost: dict[str, int] = {}
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(LOOK_EVERY, self._look, clock=steady)

    def describe(self, status: Status) -> None:
        """Put what is missing, and how much has arrived, into a report."""
        for each in self._inputs:
            status.values[f"received {each.topic}"] = each.received
            status.values[f"lost {each.topic}"] = each.lost
            complaint = each.complaint(self._options)
            if complaint is not None:
                status.note(*complaint)
            elif each.lost > self._lost.get(each.topic, 0):
                status.note(WARN, f"samples on '{each.topic}' are lost before they get here")
            self._lost[each.topic] = each.lost

    def _look(self) -> None:
        for each in self._inputs:
            complaint = each.complaint(self._options)
            kind = complaint and complaint.message.split(" for ")[0]
            if kind == self._said.get(each.topic):
                continue
            self._said[each.topic] = kind
            if complaint is not None:
                self._node.get_logger().warning(complaint.message)
            else:
                self._node.get_logger().info(f"topic '{each.topic}' delivers")


def watched_publisher(node: Node, message_type: Any, topic: str, profile: QoSProfile) -> Publisher:
    """Return a publisher that warns when a subscriber asks for a QoS it does not offer."""

    def warn(event: Any) -> None:
        policy = qos_policy_name_from_kind(event.last_policy_kind)
        node.get_logger().warning(
            f"a subscriber of '{publisher.topic_name}' asks for a QoS that is not offered "
            f"({policy}) and receives nothing"
        )

    def create(events: PublisherEventCallbacks) -> Publisher:
        return node.create_publisher(message_type, topic, profile, event_callbacks=events)

    try:
        publisher = create(PublisherEventCallbacks(incompatible_qos=warn))
    except UnsupportedEventTypeError:
        publisher = create(PublisherEventCallbacks())
    return publisher


def _misfit(offered: QoSProfile, asked: QoSProfile) -> str | None:
    """Return in words why a publisher does not fit, or None when it does."""
    compatibility, reason = qos_check_compatible(offered, asked)
    if compatibility != QoSCompatibility.ERROR:
        return None
    return str(reason).lower().replace("error: ", "").rstrip(";").replace(";", ", ")


def _type_name(message_type: Any) -> str:
    package = message_type.__module__.split(".")[0]
    return f"{package}/msg/{message_type.__name__}"
