"""Search for the topics of feet whose usual topics nobody publishes: by type, then by name."""

from __future__ import annotations

from collections.abc import Mapping

from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from ...core import FEET
from ...recording import IMU_TYPE, topics_of_foot
from ..ros.watched_input import WatchedInput

LOOK_EVERY = 0.5  # s
PATIENCE = 3  # looks without a publisher, after which others are looked for
OWN = ("imu/data_raw", "imu/data_sync")  # of the nodes of this package


class TopicSearch:
    """Search for an Imu topic of each foot whose name says the foot.

    It ends for a foot when its usual topic has a publisher, was remapped, or another was found.
    ``taken`` holds what was found, by foot.
    """

    def __init__(
        self,
        node: Node,
        inputs: Mapping[str, WatchedInput],
        usual: Mapping[str, str],
        how: str,
        space: str | None = None,
    ) -> None:
        """Watch over ``inputs``, by foot.

        Parameters
        ----------
        usual : name of the usual topic of each foot
        how : how to choose, for a user whose topics are not found
        space : namespace in which the nodes of this package publish (None: that of ``node``)
        """
        self.taken: dict[str, str] = {}
        self._node, self._usual, self._how = node, usual, how
        space = (node.get_namespace() if space is None else space).rstrip("/")
        self._own = {f"{space}/{foot}/{name}" for foot in FEET for name in OWN}
        self._open = {f: w for f, w in inputs.items() if _is_usual(node, w, usual[f])}
        self._looks = 0
        self._listed: list[str] = []
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(LOOK_EVERY, self.look, clock=steady)

    def look(self) -> None:
        """Look once; take topics that are found, and say so, or say how to choose."""
        for foot, watched in list(self._open.items()):
            if watched.received or self._node.count_publishers(watched.topic):
                del self._open[foot]
        self._looks += 1
        if not self._open:
            self._timer.cancel()
        elif self._looks > PATIENCE:
            self._search()

    def _search(self) -> None:
        seen = self._list_topics()
        found = {foot: topics_of_foot(foot, seen) for foot in self._open}
        if all(len(topics) == 1 for topics in found.values()):
            self._take({foot: topics[0] for foot, topics in found.items()})
        elif seen and seen != self._listed:
            self._listed = seen
            self._node.get_logger().warning(self._describe_choice(seen))

    def _take(self, topics: Mapping[str, str]) -> None:
        usual = " or ".join(self._open[foot].topic for foot in topics)
        for foot, topic in topics.items():
            self._open.pop(foot).move(topic)
        self.taken |= topics
        words = " and ".join(f"{topic} as {foot}" for foot, topic in topics.items())
        says = "the name says" if len(topics) == 1 else "the names say"
        self._node.get_logger().info(
            f"taking {words}, because {says} so and nobody publishes {usual}"
        )

    def _list_topics(self) -> list[str]:
        """Return the Imu topics that others publish, but for those already used."""
        return sorted(
            topic
            for topic, types in self._node.get_topic_names_and_types()
            if IMU_TYPE in types and topic not in self._own and self._node.count_publishers(topic)
        )

    def _describe_choice(self, seen: list[str]) -> str:
        usual = " and ".join(watched.topic for watched in self._open.values())
        return (
            f"nobody publishes {usual}, and the names of the sensor_msgs/Imu topics that are "
            f"there do not say which foot is which: {', '.join(seen)}; choose with {self._how}"
        )


def _is_usual(node: Node, watched: WatchedInput, name: str) -> bool:
    """Return whether an input has its usual topic and was not remapped by its user."""
    return bool(watched.topic == node.resolve_topic_name(name, only_expand=True))
