"""Every parameter of the tracker with default, unit, range and meaning: the one source."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

from .constraints import METHODS
from .errors import ConfigError
from .groups import (
    AidsConfig,
    AlignmentConfig,
    FloorConfig,
    HeadingConfig,
    IncrementsConfig,
    InitialConfig,
    NoiseConfig,
    StanceConfig,
    ZuptConfig,
)
from .parameters import Parameters, ParameterSpec, parameter
from .samples.units import STANDARD_GRAVITY

GROUPS: dict[str, type[Parameters]] = {
    "increments": IncrementsConfig,
    "alignment": AlignmentConfig,
    "heading": HeadingConfig,
    "noise": NoiseConfig,
    "initial": InitialConfig,
    "stance": StanceConfig,
    "zupt": ZuptConfig,
    "floor": FloorConfig,
    "aids": AidsConfig,
}


@dataclass(frozen=True)
class TrackerConfig(Parameters):
    """The whole configuration: the method's name, the common groups, each method's own group."""

    method: str = parameter(
        "spacing_vector", "which system of the papers to run", choices=METHODS.names
    )
    gravity: float = parameter(
        STANDARD_GRAVITY, "local gravity", unit="m/s^2", minimum=9.7, maximum=9.9
    )
    increments: IncrementsConfig = field(default_factory=IncrementsConfig)
    alignment: AlignmentConfig = field(default_factory=AlignmentConfig)
    heading: HeadingConfig = field(default_factory=HeadingConfig)
    noise: NoiseConfig = field(default_factory=NoiseConfig)
    initial: InitialConfig = field(default_factory=InitialConfig)
    stance: StanceConfig = field(default_factory=StanceConfig)
    zupt: ZuptConfig = field(default_factory=ZuptConfig)
    floor: FloorConfig = field(default_factory=FloorConfig)
    aids: AidsConfig = field(default_factory=AidsConfig)
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


def all_specs(methods: Iterable[str] | None = None) -> Iterator[ParameterSpec]:
    """Yield every parameter of the tracker by dotted name, common groups first, then methods.

    ``methods`` are the names of those whose parameters are wanted (default: all).
    """
    yield from TrackerConfig.specs()
    for item in fields(TrackerConfig):
        if item.name in GROUPS:
            yield from GROUPS[item.name].specs(f"{item.name}.")
    for name in METHODS if methods is None else methods:
        yield from method_parameters(name).specs(f"{name}.")


def method_parameters(name: str) -> type[Parameters]:
    """Return the parameter class of a method."""
    return METHODS[name].config_class


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
