"""Publisher that warns of subscribers which cannot receive from it."""

from __future__ import annotations

from typing import Any

from rclpy.event_handler import PublisherEventCallbacks, UnsupportedEventTypeError
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, qos_policy_name_from_kind


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
