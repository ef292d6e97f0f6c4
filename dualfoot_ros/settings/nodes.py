"""Parameters of the ROS nodes, without those of the tracker; declared here without any ROS."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..core import FEET, Increments, MountingConfig, Parameters, ParameterSpec, parameter
from ..drivers import CheckConfig
from ..timing import POLICIES, AlignerConfig, DeviceClockConfig, StampConfig
from .page_config import PageConfig

SYNC_CHOICES = ("internal", "external")
FROM_SOURCE = "from_source"


@dataclass(frozen=True)
class InputConfig(Parameters):
    """Inputs of a node: queues, and when a silent one is an error."""

    depth: int = parameter(
        1000, "queue of each input, samples (2 s at 500 Hz)", minimum=1, maximum=100000
    )
    latency: float = parameter(
        2.0,
        "when a sample has waited so long for this process, those that wait are dropped down to "
        "the newest, counted and said (0: never, for runs faster than real time)",
        unit="s",
        minimum=0.0,
        maximum=60.0,
    )
    silence: float = parameter(
        2.5,
        "error when an input was silent for so long; of one that has not begun yet, a warning",
        unit="s",
        minimum=0.1,
        maximum=3600.0,
    )
    first: float = parameter(
        20.0,
        "error when the first sample takes longer, from when its publisher or link is there; "
        "meanwhile a device connects and its clock is learnt",
        unit="s",
        minimum=0.0,
        maximum=3600.0,
    )


@dataclass(frozen=True)
class FrameConfig(Parameters):
    """Frame ids of the messages that fusion publishes."""

    odom: str = parameter("odom", "frame of the trajectories; map if steps disturb its users")
    left: str = parameter("left_foot", "frame of the left foot's sensor")
    right: str = parameter("right_foot", "frame of the right foot's sensor")
    pedestrian: str = parameter("base_footprint", "frame of the person between the feet")
    prefix: str = parameter(
        "", "put before each of these names, to have several people in one graph: anna/"
    )

    def prefixed(self) -> FrameConfig:
        """Return the names with the prefix before each."""
        names = (self.odom, self.left, self.right, self.pedestrian)
        return FrameConfig(*(self.prefix + name for name in names))


@dataclass(frozen=True)
class PathConfig(Parameters):
    """Paths of the feet: one pose a stance and the newest."""

    length: int = parameter(1000, "poses kept; the oldest are dropped", minimum=2, maximum=100000)
    period: float = parameter(
        1.0, "least time between two messages", unit="s", minimum=1.0, maximum=60.0
    )


@dataclass(frozen=True)
class PersonConfig(Parameters):
    """What fusion publishes of the person between the feet."""

    window: float = parameter(
        1.0,
        "length of the mean of odometry/smoothed, which lags by half of it; about a stride",
        unit="s",
        minimum=0.2,
        maximum=5.0,
    )
    smoothed_rate: float = parameter(
        50.0, "most messages a second of odometry/smoothed", unit="Hz", minimum=1.0, maximum=1000.0
    )
    trust_limit: float = parameter(
        3.0,
        "95 % radius of the position up to which it is trusted",
        unit="m",
        minimum=0.01,
        maximum=1.0e4,
    )


@dataclass(frozen=True)
class FusionConfig(Parameters):
    """Parameters of the node ``fusion`` itself."""

    sync: str = parameter(
        "internal",
        "internal: align two raw streams here; external: take pairs with equal stamps",
        choices=SYNC_CHOICES,
    )
    feet: str = parameter(
        "both",
        "left or right: track that foot alone, and neither listen to the other nor wait for it",
        choices=("both", *FEET),
    )
    publish_tf: bool = parameter(False, "broadcast the frames too (needs tf2_msgs)")
    engine: str = parameter(
        "auto",
        "form of the kernel; auto starts at once and goes over to the compiled form",
        choices=("auto", "compiled", "interpreted"),
    )
    calibration: str = parameter(
        "",
        "file of 'dualfoot calibrate' for samples that imu_adapter has not corrected already "
        "(empty: none)",
    )
    bias_memory: str = parameter(
        "",
        "file with the gyro biases of earlier walks of these two sensors, read at the start and "
        "written at the end (empty: none)",
    )


@dataclass(frozen=True)
class ReportConfig(Parameters):
    """Reports of a node on /diagnostics."""

    period: float = parameter(1.0, "period of /diagnostics", unit="s", minimum=0.1, maximum=60.0)


@dataclass(frozen=True)
class AdapterConfig(Parameters):
    """Parameters of the node ``imu_adapter`` itself."""

    source: str = parameter(
        "topic:///imu",
        "where samples come from: topic:///NAME, file://PATH (bag or Xsens csv), or a device: "
        "serial://, udp://, tcp://, ble://, see docs/reference/sensors.md",
    )
    foot: str = parameter(
        "auto",
        "which foot this is: of a bag to play, of a calibration to use (auto: by namespace)",
        choices=("auto", "left", "right"),
    )
    frame_id: str = parameter("", "frame id to publish (empty: as received)")
    stamp: str = parameter(
        "auto",
        "stamp of a sample: header as it came, device the same as time of the device's clock "
        "followed on the host's, arrival the time it came, even that of the header (or of the "
        "arrival) at the regular intervals of the sensor; auto: device for devices, else header",
        choices=("auto", *POLICIES),
    )
    stamp_offset: float = parameter(
        0.0, "added to every stamp", unit="s", minimum=-1.0e9, maximum=1.0e9
    )
    calibration: str = parameter(
        "",
        "file of 'dualfoot calibrate', in the axes of the source (empty: none); the foot is that "
        "of the namespace",
    )


@dataclass(frozen=True)
class UnitConfig(Parameters):
    """Units of the source; the published messages are SI."""

    specific_force: str = parameter("m/s^2", "of the source", choices=("m/s^2", "g"))
    angular_rate: str = parameter("rad/s", "of the source", choices=("rad/s", "deg/s"))


@dataclass(frozen=True)
class KindConfig(Parameters):
    """What the samples of one sensor are."""

    kind: str = parameter(
        FROM_SOURCE,
        "what the samples are, published for fusion; from_source: as the file or the device says, "
        "and nothing where it does not, see docs/explanation/samples.md",
        choices=(FROM_SOURCE, *(kind.value for kind in Increments)),
    )

    @property
    def given(self) -> Increments | None:
        """The kind that is given, None to take that of the source."""
        return None if self.kind == FROM_SOURCE else Increments(self.kind)


@dataclass(frozen=True)
class CovarianceConfig(Parameters):
    """Noise that is published with every sample, where it is known."""

    specific_force_std: float = parameter(
        0.0, "0: as received", unit="m/s^2", minimum=0.0, maximum=10.0
    )
    angular_rate_std: float = parameter(
        0.0, "0: as received", unit="rad/s", minimum=0.0, maximum=10.0
    )


@dataclass(frozen=True)
class PlayConfig(Parameters):
    """Playback of a recording."""

    rate: float = parameter(1.0, "speed, as a multiple of real time", minimum=0.01, maximum=1000.0)
    loop: bool = parameter(False, "start again at the end")
    delay: float = parameter(
        0.0, "wait before the first sample", unit="s", minimum=0.0, maximum=3600.0
    )
    wait: float = parameter(
        10.0,
        "wait so long at most for a subscriber of each topic (0: do not wait)",
        unit="s",
        minimum=0.0,
        maximum=3600.0,
    )


@dataclass(frozen=True)
class ReplayConfig(Parameters):
    """Parameters of the node ``replay`` itself."""

    bag: str = parameter("", "the bag to play: a folder of rosbag2, or a single mcap file")
    clock: bool = parameter(True, "publish /clock")
    topic: str = parameter(
        "data_raw",
        "publish as raw samples, or as samples with equal stamps",
        choices=("data_raw", "data_sync"),
    )


@dataclass(frozen=True)
class BringupConfig(Parameters):
    """Parameters of ``bringup``: the nodes that it starts in its process."""

    adapters: bool = parameter(True, "start left/imu_adapter and right/imu_adapter")
    bag: str = parameter("", "play this bag with replay, in place of the adapters")
    record: str = parameter("", "write what is received and published to this bag")


GROUPS: dict[str, type[Parameters]] = {
    "aligner": AlignerConfig,
    "input": InputConfig,
    "frames": FrameConfig,
    "path": PathConfig,
    "person": PersonConfig,
    "reports": ReportConfig,
    "mounting": MountingConfig,
    "units": UnitConfig,
    "increments": KindConfig,
    "covariance": CovarianceConfig,
    "checks": CheckConfig,
    "stamping": StampConfig,
    "clock": DeviceClockConfig,
    "play": PlayConfig,
}
NODES: dict[str, tuple[type[Parameters], tuple[str, ...]]] = {
    "fusion": (
        FusionConfig,
        ("aligner", "stamping", "clock", "input", "frames", "path", "person", "reports"),
    ),
    "imu_adapter": (
        AdapterConfig,
        (
            *("mounting", "units", "increments", "covariance", "checks", "clock"),
            *("play", "input", "reports"),
        ),
    ),
    "time_sync": (Parameters, ("aligner", "stamping", "clock", "input", "reports")),
    "replay": (ReplayConfig, ("play", "reports")),
    "bringup": (BringupConfig, ()),
    "live_page": (PageConfig, ()),
}


def node_specs(node: str) -> Iterator[ParameterSpec]:
    """Yield the parameters of a node by dotted name, without those of the tracker."""
    own, groups = NODES[node]
    yield from own.specs()
    for group in groups:
        yield from GROUPS[group].specs(f"{group}.")


def node_parameter_names() -> set[str]:
    """Return the names of the parameters of all nodes, without those of the tracker."""
    return {spec.name for node in NODES for spec in node_specs(node)}
