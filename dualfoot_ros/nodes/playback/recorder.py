"""Recorder of topics to a bag, which is written whole, or up to where its disk was full."""

from __future__ import annotations

import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from ...core import os_error_text
from ...recording import METADATA, RecordingError, new_bag, new_directory


class RecorderNode(Node):
    """Node that records topics as they come, in MCAP, at the time of its clock."""

    def __init__(
        self, path: Path, topics: dict[str, tuple[Any, QoSProfile]], **options: Any
    ) -> None:
        """Record ``topics``, name -> (message type, profile), to the new folder ``path``.

        Raises
        ------
        RecordingError
            When ``path`` exists already.
        OSError
            When it cannot be written.
        """
        super().__init__("recorder", **options)
        if path.exists():
            raise RecordingError(f"'{path}' exists already; choose another name to record to")
        self.recorded = 0
        self._path, self._gave_up = path, False
        self._folder, self._bag = ExitStack(), ExitStack()
        folder = self._folder.enter_context(new_directory(path, overwrite=False, marker=METADATA))
        self._writer = self._bag.enter_context(new_bag(folder, "mcap", packed=False))
        self._inputs = [self._subscribe(name, *item) for name, item in topics.items()]

    def _subscribe(self, topic: str, message_type: Any, profile: QoSProfile) -> Any:
        name = self.resolve_topic_name(topic)
        package = message_type.__module__.split(".")[0]
        type_name = f"{package}/msg/{message_type.__name__}"
        is_latched = profile.durability is DurabilityPolicy.TRANSIENT_LOCAL
        key = self._writer.add_topic(
            name, type_name, latched_depth=profile.depth if is_latched else 0
        )

        def write(data: bytes) -> None:
            if self._gave_up:
                return
            try:
                self._writer.write(key, self._now_ns(), data)
                self.recorded += 1
            except OSError as error:
                self._give_up(error)
                self._bag.__exit__(type(error), error, error.__traceback__)

        return self.create_subscription(message_type, topic, write, profile, raw=True)

    def _now_ns(self) -> int:
        """Return the time of the node's clock, or of the wall before /clock has come."""
        return self.get_clock().now().nanoseconds or time.time_ns()

    def _give_up(self, error: OSError) -> None:
        """Record no more, and say so; the other nodes go on, and what was written stays."""
        self._gave_up = True
        self.get_logger().error(
            f"nothing more is recorded to '{self._path}': {os_error_text(error)}; what was "
            "written until now stays there, as a bag that was cut off"
        )

    def destroy_node(self) -> None:
        """Close the bag, then destroy the node."""
        try:
            self._bag.close()
        except OSError as error:
            self._give_up(error)
        self._folder.close()
        super().destroy_node()
