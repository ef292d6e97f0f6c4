"""Topics that say what the samples of the feet are, as inputs and as outputs; latched."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import String

from ...core import FEET, Increments, IncrementsConfig
from ...recording import Topics
from ..ros import qos
from ..ros.status import Status
from ..ros.watched_publisher import watched_publisher

TOPICS = {foot: Topics().of(foot).increments.lstrip("/") for foot in FEET}
Take = Callable[[str, Increments], None]


class IncrementsInputs:
    """Subscriptions to what both feet's sources say of their samples.

    Attributes
    ----------
    declared : what was said last, by foot; absent where nothing was
    """

    def __init__(self, node: Node, config: IncrementsConfig, take: Take) -> None:
        """``take`` is called with foot and kind; ``config`` wins over it."""
        self.declared: dict[str, Increments] = {}
        self._config, self._take, self._log = config, take, node.get_logger()
        self._inputs = [
            node.create_subscription(String, TOPICS[foot], self._receiver(foot), qos.latched())
            for foot in FEET
        ]

    def _receiver(self, foot: str) -> Callable[[String], None]:
        return lambda message: self.receive(foot, message.data)

    def receive(self, foot: str, text: str) -> None:
        """Take what the source of ``foot`` says; warn of what is no kind."""
        if text not in tuple(Increments):
            allowed = ", ".join(Increments)
            self._log.warning(
                f"topic '{TOPICS[foot]}' says '{text}' and is ignored; allowed is one of {allowed}"
            )
            return
        self.declared[foot] = Increments(text)
        self._take(foot, self.declared[foot])

    def log(self) -> None:
        """Log for both feet what their samples are taken for, and who says it."""
        for foot in FEET:
            kind, source = self._find(foot)
            text = f"{foot} foot: samples are taken for {kind.words} ({kind}), {source}"
            if self._is_unknown(foot):
                self._log.warning(f"{text}; set increments.{foot} or increments.kind of its node")
            else:
                self._log.info(text)

    def describe(self, status: Status) -> None:
        """Add to a status what the samples are taken for."""
        for foot in FEET:
            kind, source = self._find(foot)
            status.values[f"{foot} increments"] = f"{kind}, {source}"

    def _find(self, foot: str) -> tuple[Increments, str]:
        """Return what the samples of ``foot`` are, and in words who says it."""
        said = self.declared.get(foot)
        kind = self._config.of(foot, said)
        if self._config.is_given(foot):
            return kind, "as the parameters say"
        return kind, "as nothing says what they are" if said is None else "as their source says"

    def _is_unknown(self, foot: str) -> bool:
        return not self._config.is_given(foot) and foot not in self.declared


class IncrementsOutput:
    """Publisher of what one sensor's samples are, as soon as that is known."""

    def __init__(self, node: Node, topic: str) -> None:
        """Publish on ``topic``."""
        self.kind: Increments | None = None
        self._out = watched_publisher(node, String, topic, qos.latched())

    def declare(self, kind: Increments | None) -> None:
        """Publish ``kind`` where it is known and was not published before."""
        if kind is not None and kind is not self.kind:
            self.kind = kind
            self._out.publish(String(data=kind.value))

    def describe(self, status: Status) -> None:
        """Add to a status what the samples are."""
        status.values["increments"] = self.kind.value if self.kind else "unknown"
