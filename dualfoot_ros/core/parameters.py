"""Parameters as data: frozen dataclasses that know their units, ranges and meaning.

Every parameter group of the package derives from :class:`Parameters` and declares its fields with
:func:`parameter`.  YAML files, ROS parameter descriptors, the command line and the tables of the
README are all generated from, or checked against, what stands there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, Self

from .errors import ConfigError


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter as others need to see it: a dotted name, its default, unit, range, meaning."""

    name: str
    default: Any
    unit: str
    minimum: float | None
    maximum: float | None
    choices: tuple[str, ...] | None
    description: str

    @property
    def allowed(self) -> str:
        """What values are allowed, in words."""
        if self.choices is not None:
            return "one of " + ", ".join(self.choices)
        low = "-inf" if self.minimum is None else f"{self.minimum:g}"
        high = "inf" if self.maximum is None else f"{self.maximum:g}"
        unit = f" {self.unit}" if self.unit else ""
        if isinstance(self.default, bool):
            return "true or false"
        if isinstance(self.default, str):
            return "a text"
        if isinstance(self.default, tuple):
            return f"{len(self.default)} numbers in [{low}, {high}]{unit}"
        kind = "a whole number" if isinstance(self.default, int) else "a number"
        return f"{kind} in [{low}, {high}]{unit}"


def parameter(
    default: Any,
    description: str,
    *,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: tuple[str, ...] | None = None,
) -> Any:
    """Declare a field of a :class:`Parameters` class; the type is the type of its default."""
    meta = {
        "unit": unit,
        "minimum": minimum,
        "maximum": maximum,
        "choices": choices,
        "description": description,
    }
    return field(default=default, metadata=meta)


@dataclass(frozen=True)
class Parameters:
    """Base of every parameter group; values are checked when an instance is made."""

    def __post_init__(self) -> None:
        """Check every field against its declaration; raise :class:`ConfigError` on a misfit."""
        for spec in self.specs():
            value = check(spec, getattr(self, spec.name))
            object.__setattr__(self, spec.name, value)

    @classmethod
    def specs(cls, prefix: str = "") -> Iterator[ParameterSpec]:
        """Yield the declared parameters, their names prefixed with ``prefix``."""
        for item in fields(cls):
            if "description" in item.metadata and item.default is not MISSING:
                yield ParameterSpec(name=prefix + item.name, default=item.default, **item.metadata)

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any], prefix: str = "") -> Self:
        """Build the group from plain values; unknown names and bad values raise ConfigError."""
        known = {spec.name: spec for spec in cls.specs()}
        values = {}
        for name, value in mapping.items():
            if name not in known:
                raise ConfigError(
                    f"unknown parameter '{prefix}{name}'; known: {', '.join(sorted(known))}"
                )
            values[name] = check(known[name], value, prefix)
        return cls(**values)


def check(spec: ParameterSpec, value: Any, prefix: str = "") -> Any:
    """Return ``value`` as the type of the parameter, or raise :class:`ConfigError` saying why."""
    try:
        value = _converted(spec.default, value)
    except (TypeError, ValueError, OverflowError):
        raise _refusal(spec, value, prefix) from None
    if spec.choices is not None and value not in spec.choices:
        raise _refusal(spec, value, prefix)
    for number in value if isinstance(value, tuple) else (value,):
        if isinstance(number, (bool, str)):
            continue
        low_ok = spec.minimum is None or number >= spec.minimum
        high_ok = spec.maximum is None or number <= spec.maximum
        if not (math.isfinite(number) and low_ok and high_ok):
            raise _refusal(spec, value, prefix)
    return value


def _converted(default: Any, value: Any) -> Any:
    if isinstance(default, (bool, str)):
        if type(value) is not type(default):
            raise TypeError
        return value
    if isinstance(default, tuple):
        if isinstance(value, str) or len(value) != len(default):
            raise ValueError
        return tuple(float(_number(v)) for v in value)
    if isinstance(default, int):
        if int(_number(value)) != value:
            raise ValueError
        return int(value)
    return float(_number(value))


def _number(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise TypeError
    return value


def _refusal(spec: ParameterSpec, value: Any, prefix: str) -> ConfigError:
    shown = list(value) if isinstance(value, tuple) else value
    return ConfigError(f"parameter '{prefix}{spec.name}' is {shown!r}; allowed is {spec.allowed}")
