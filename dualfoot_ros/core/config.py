"""Every parameter of the tracker with default, unit, range and meaning: the one source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

from .config_aids import Aids
from .constraints import METHODS
from .errors import ConfigError
from .parameters import Parameters, ParameterSpec, parameter


@dataclass(frozen=True)
class Alignment(Parameters):
    """Levelling and gyro bias from a standstill that is checked, not assumed."""

    duration: float = parameter(
        2.0, "standstill needed before output starts", unit="s", minimum=0.5, maximum=60.0
    )
    window: float = parameter(
        0.75, "length of the window that is checked", unit="s", minimum=0.1, maximum=5.0
    )
    still_rate_std: float = parameter(
        1.0e-3,
        "angular rate scatter below which windows count alike; above it by 1 / scatter^4",
        unit="rad/s",
        minimum=1e-6,
        maximum=1.0,
    )
    max_rate_std: float = parameter(
        0.03, "angular rate scatter of a still window", unit="rad/s", minimum=1e-5, maximum=1.0
    )
    max_force_std: float = parameter(
        0.15, "specific force scatter of a still window", unit="m/s^2", minimum=1e-4, maximum=5.0
    )
    max_rate: float = parameter(
        0.15,
        "mean angular rate (a bias) of a still window",
        unit="rad/s",
        minimum=0.0,
        maximum=1.0,
    )
    max_gravity_error: float = parameter(
        1.0, "mean specific force may differ from g by", unit="m/s^2", minimum=0.01, maximum=5.0
    )


@dataclass(frozen=True)
class Heading(Parameters):
    """What the x axis of the navigation frame is."""

    source: str = parameter(
        "first_strides",
        "x axis along the first strides, along the sensors' own x axes, or given for both feet",
        choices=("first_strides", "sensor", "given"),
    )
    given: float = parameter(
        0.0,
        "heading of the first strides in the navigation frame (source: given)",
        unit="rad",
        minimum=-6.3,
        maximum=6.3,
    )
    from_stance: int = parameter(1, "first stance that fixes the direction", minimum=0, maximum=20)
    to_stance: int = parameter(3, "last stance that fixes the direction", minimum=1, maximum=40)

    def __post_init__(self) -> None:
        """Check that the two stances are in order."""
        super().__post_init__()
        if self.from_stance >= self.to_stance:
            raise ConfigError(
                f"parameter 'heading.to_stance' is {self.to_stance}; allowed is more than "
                f"heading.from_stance, {self.from_stance}"
            )


@dataclass(frozen=True)
class Noise(Parameters):
    """Sensor model: densities for Q, eq. (8) of Liu et al. 2023."""

    gyro: float = parameter(
        3.0e-3, "angular rate noise density", unit="rad/s/sqrt(Hz)", minimum=0.0, maximum=1.0
    )
    accelerometer: float = parameter(
        2.0e-2, "specific force noise density", unit="m/s^2/sqrt(Hz)", minimum=0.0, maximum=10.0
    )
    gyro_bias: float = parameter(
        2.0e-6, "gyro bias driving noise", unit="rad/s/sqrt(s)", minimum=0.0, maximum=1.0
    )
    accelerometer_bias: float = parameter(
        2.0e-5, "accelerometer bias driving noise", unit="m/s^2/sqrt(s)", minimum=0.0, maximum=1.0
    )
    bias_time: float = parameter(
        1800.0, "correlation time of the biases", unit="s", minimum=1.0, maximum=1e9
    )


@dataclass(frozen=True)
class Initial(Parameters):
    """Standard deviations of the initial error state (P0)."""

    position: float = parameter(0.02, "position", unit="m", minimum=0.0, maximum=100.0)
    velocity: float = parameter(0.01, "velocity", unit="m/s", minimum=0.0, maximum=10.0)
    tilt: float = parameter(0.01, "roll and pitch", unit="rad", minimum=0.0, maximum=1.0)
    yaw: float = parameter(
        0.03, "yaw against the first strides", unit="rad", minimum=0.0, maximum=3.2
    )
    gyro_bias: float = parameter(
        1.0e-4, "gyro bias, the least of it", unit="rad/s", minimum=0.0, maximum=1.0
    )
    accelerometer_bias: float = parameter(
        0.1, "accelerometer bias", unit="m/s^2", minimum=0.0, maximum=5.0
    )
    spacing: float = parameter(
        0.15, "lateral distance of the feet at the start", unit="m", minimum=0.0, maximum=1.0
    )


@dataclass(frozen=True)
class Stance(Parameters):
    """GLRT stance detector (Skog et al. 2010) and the clean-up of impossible phases."""

    window: float = parameter(0.05, "GLRT window W", unit="s", minimum=0.005, maximum=0.5)
    threshold: float = parameter(
        6000.0, "GLRT threshold gamma (dimensionless)", minimum=1.0, maximum=1e9
    )
    gyro_std: float = parameter(
        1.4e-2, "angular rate noise in the GLRT", unit="rad/s", minimum=1e-6, maximum=1.0
    )
    force_std: float = parameter(
        4.2e-2, "specific force noise in the GLRT", unit="m/s^2", minimum=1e-6, maximum=10.0
    )
    min_stance: float = parameter(
        0.1, "a shorter stance is none", unit="s", minimum=0.0, maximum=1.0
    )
    min_swing: float = parameter(
        0.12, "a shorter swing is none", unit="s", minimum=0.0, maximum=1.0
    )


@dataclass(frozen=True)
class Zupt(Parameters):
    """Zero-velocity update, eq. (12), at the point about which the foot pivots."""

    std: float = parameter(0.05, "velocity noise in stance", unit="m/s", minimum=1e-4, maximum=1.0)
    rate_std: float = parameter(
        0.05,
        "velocity noise added per angular rate",
        unit="m/s per rad/s",
        minimum=0.0,
        maximum=1.0,
    )
    still_std: float = parameter(
        0.002, "velocity noise standing still", unit="m/s", minimum=1e-5, maximum=1.0
    )
    still_after: float = parameter(
        1.5, "a stance this long is standing still", unit="s", minimum=0.2, maximum=1e6
    )
    lever_arm: float = parameter(
        0.09,
        "height of the sensor above the pivot of the foot (0: the papers' plain ZUPT)",
        unit="m",
        minimum=0.0,
        maximum=0.5,
    )
    lever_back: float = parameter(
        0.08,
        "how far the pivot is behind the sensor, along the foot",
        unit="m",
        minimum=-0.3,
        maximum=0.3,
    )


GROUPS: dict[str, type[Parameters]] = {
    "alignment": Alignment,
    "heading": Heading,
    "noise": Noise,
    "initial": Initial,
    "stance": Stance,
    "zupt": Zupt,
    "aids": Aids,
}


@dataclass(frozen=True)
class TrackerConfig(Parameters):
    """The whole configuration: the method's name, the common groups, each method's own group."""

    method: str = parameter(
        "spacing_vector", "which system of the papers to run", choices=tuple(METHODS)
    )
    gravity: float = parameter(9.80665, "local gravity", unit="m/s^2", minimum=9.7, maximum=9.9)
    alignment: Alignment = field(default_factory=Alignment)
    heading: Heading = field(default_factory=Heading)
    noise: Noise = field(default_factory=Noise)
    initial: Initial = field(default_factory=Initial)
    stance: Stance = field(default_factory=Stance)
    zupt: Zupt = field(default_factory=Zupt)
    aids: Aids = field(default_factory=Aids)
    methods: Mapping[str, Parameters] = field(default_factory=dict)

    @property
    def constraint(self) -> Parameters:
        """Parameters of the selected method."""
        return self.methods.get(self.method, method_parameters(self.method)())

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any], prefix: str = "") -> Self:
        """Build a configuration from nested or dotted keys, as in ``config/*.yaml``.

        Raises
        ------
        ConfigError
            Naming the parameter, its value and what is allowed.
        """
        tree = nested(mapping)
        methods = {}
        values: dict[str, Any] = {}
        for name, value in tree.items():
            group = GROUPS.get(name)
            if group is not None:
                values[name] = group.from_mapping(_section(name, value), f"{name}.")
            elif name in METHODS:
                group = method_parameters(name)
                methods[name] = group.from_mapping(_section(name, value), f"{name}.")
            elif name in ("method", "gravity"):
                values[name] = value
            else:
                known = ["method", "gravity", *GROUPS, *METHODS]
                raise ConfigError(f"unknown parameter '{name}'; known: {', '.join(known)}")
        return cls(**values, methods=methods)

    def to_mapping(self) -> dict[str, Any]:
        """Return every parameter with its value, by dotted name."""
        return {spec.name: self._value(spec.name) for spec in all_specs()}

    def _value(self, name: str) -> Any:
        group, _, key = name.rpartition(".")
        if not group:
            return getattr(self, key)
        if group in GROUPS:
            return getattr(getattr(self, group), key)
        return getattr(self.methods.get(group, method_parameters(group)()), key)


def all_specs() -> Iterator[ParameterSpec]:
    """Yield every parameter of the tracker by dotted name, common groups first, then methods."""
    yield from TrackerConfig.specs()
    for item in fields(TrackerConfig):
        if item.name in GROUPS:
            yield from GROUPS[item.name].specs(f"{item.name}.")
    for name in METHODS:
        yield from method_parameters(name).specs(f"{name}.")


def method_parameters(name: str) -> type[Parameters]:
    """Return the parameter class of a method."""
    found: type[Parameters] = METHODS[name].Config
    return found


def nested(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``mapping`` with dotted keys turned into nested ones."""
    tree: dict[str, Any] = {}
    for key, value in mapping.items():
        node = tree
        *path, leaf = str(key).split(".")
        for part in path:
            node = node.setdefault(part, {})
            if not isinstance(node, dict):
                raise ConfigError(f"parameter '{key}' is both a value and a group")
        if isinstance(value, Mapping):
            existing = node.setdefault(leaf, {})
            existing.update(nested(value))
        else:
            node[leaf] = value
    return tree


def _section(name: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise ConfigError(f"parameter '{name}' is {value!r}; allowed is a group of parameters")
    return value
