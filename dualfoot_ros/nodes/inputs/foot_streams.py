"""Streams of both feet: their samples stamped, the stamps compared, the samples paired."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Imu

from ...core import FEET, FloatArray, ImuPair
from ...settings import InputConfig
from ...timing import Aligner, AlignerConfig, DeviceClockConfig, StampConfig
from ..ros import qos
from ..ros.cdr_imu import ImuBytes
from ..ros.declared_parameters import group
from ..ros.status import Status
from ..ros.watched_input import InputMonitor, Watched, WatchedInput
from .foot_states import FootStates
from .stamp_checks import StampChecks
from .stamp_gap import StampGap
from .stamper import Stamper
from .topic_search import TopicSearch

ReadSample = Callable[[str, ImuBytes, int], FloatArray]
RAW = "imu/data_raw"
CHOOSE = f"--ros-args -r left/{RAW}:=/TOPIC -r right/{RAW}:=/TOPIC"
TakePair = Callable[[ImuPair], None]


class FootStreams:
    """Subscriptions to ``left/TOPIC`` and ``right/TOPIC``, from which pairs are made.

    Attributes
    ----------
    inputs : the subscriptions, by foot
    stamper : gives each sample its stamp, or refuses it
    aligner : makes the pairs
    states : whether each foot is there
    on_change : called when a foot has become stale, or is back
    search : looks for raw topics of other names, where nobody publishes the usual ones
    """

    def __init__(
        self,
        node: Node,
        topic: str,
        values: Mapping[str, Any],
        read_sample: ReadSample,
        take_pair: TakePair,
        *,
        stamping: StampConfig,
        also: Sequence[Watched] = (),
        remedy: str = "",
    ) -> None:
        """Subscribe.

        Parameters
        ----------
        values : the declared parameters of ``node``: those of ``aligner``, ``clock`` and
            ``input``, and ``feet`` where one foot alone can be asked for
        read_sample : called with foot, message and stamp (ns) of every sample that has one;
            returns its specific force and angular rate (6,)
        take_pair : called with every pair that is complete
        stamping : where the stamps come from
        also : further inputs to watch
        remedy : that of the finding on a silent input
        """
        self._read_sample, self._take_pair = read_sample, take_pair
        only = values.get("feet", "both")
        feet = FEET if only == "both" else (only,)
        self.aligner = Aligner(group(AlignerConfig, values, "aligner."), feet)
        self.states = FootStates(self.aligner, feet)
        self.on_change: Callable[[], None] = _do_nothing
        self.stamper = Stamper(stamping, group(DeviceClockConfig, values, "clock."))
        self._stamp_gap = StampGap(self.aligner)
        self._stamp_checks = StampChecks(self.aligner, stamping.policy)
        config = group(InputConfig, values, "input.")
        profile = qos.sensor(config.depth)
        self.inputs = {
            foot: WatchedInput(
                node,
                Imu,
                f"{foot}/{topic}",
                self._receiver(foot),
                profile,
                remedy=remedy,
                latency_s=config.latency,
                raw=True,
            )
            for foot in feet
        }
        usual = {foot: f"{foot}/{topic}" for foot in FEET}
        raw = topic == RAW
        self.search = TopicSearch(node, self.inputs, usual, CHOOSE) if raw else None
        self.monitor = InputMonitor(node, [*self.inputs.values(), *also], config)

    def _receiver(self, foot: str) -> Callable[[bytes], None]:
        return lambda data: self.receive(foot, data)

    def receive(self, foot: str, data: bytes) -> None:
        """Take the newest message of ``foot``, a serialized ``sensor_msgs/Imu``."""
        message = ImuBytes(data)
        arrival_ns, header_ns = self.inputs[foot].arrival_ns, message.stamp_ns
        stamp_ns = self.stamper.stamp(foot, header_ns, arrival_ns)
        if stamp_ns is None:
            return
        sample = self._read_sample(foot, message, stamp_ns)
        self._stamp_gap.observe(foot, stamp_ns)
        self._stamp_checks.observe(foot, header_ns, stamp_ns)
        for pair in self.aligner.push(foot, stamp_ns, sample, arrival_ns):
            self._take_pair(pair)
        if self.states.observe():
            self.on_change()

    @property
    def received(self) -> int:
        """Messages of both feet that have arrived."""
        return sum(watched.received for watched in self.inputs.values())

    @property
    def lost(self) -> int:
        """Messages of both feet that have not."""
        return sum(watched.lost for watched in self.inputs.values())

    def reset(self) -> None:
        """Forget the samples that have not been paired yet; the counters stay."""
        self.aligner.reset()

    def describe(self, status: Status) -> None:
        """Add inputs, clocks, the state of each foot and what its stamps are worth to a status."""
        self.monitor.describe(status)
        self.stamper.describe(status)
        self.states.describe(status)
        self._stamp_gap.describe(status)
        self._stamp_checks.describe(status)


def _do_nothing() -> None:
    """Do nothing, as long as nobody wants to know."""
