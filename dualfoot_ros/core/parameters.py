"""Parameters as data: frozen dataclasses that know their types, units, ranges and meaning.

Every parameter group of the package derives from :class:`Parameters` and declares its fields with
:func:`parameter`.  YAML files, ROS parameter descriptors, the command line and the tables of the
documentation are all generated from, or checked against, these declarations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, field, fields
from typing import Any, ClassVar, NamedTuple, Self, TypeVar, get_args, get_origin, get_type_hints

from .errors import ConfigError

Value = TypeVar("Value", bool, int, float, str, tuple[float, float], tuple[float, float, float])
Choices = tuple[str, ...] | Callable[[], Sequence[str]]
SCALARS = (bool, int, float, str)


class ParameterSpec(NamedTuple):
    """One parameter as others need to see it.

    Attributes
    ----------
    name : dotted name
    type : ``bool``, ``int``, ``float``, ``str`` or ``tuple`` (of numbers), from the annotation
    default : a value of that type
    minimum, maximum : range of a number, or of each number of a tuple
    choices : allowed texts, None where any text is
    """

    name: str
    type: type
    default: Any
    unit: str
    minimum: float | None
    maximum: float | None
    choices: Sequence[str] | None
    description: str

    @property
    def allowed(self) -> str:
        """Allowed values in words."""
        if self.choices is not None:
            return "one of " + ", ".join(self.choices)
        if self.type is bool:
            return "true or false"
        if self.type is str:
            return "a text"
        low = "-inf" if self.minimum is None else f"{self.minimum:g}"
        high = "inf" if self.maximum is None else f"{self.maximum:g}"
        unit = f" {self.unit}" if self.unit else ""
        if self.type is tuple:
            return f"{len(self.default)} numbers in [{low}, {high}]{unit}"
        kind = "a whole number" if self.type is int else "a number"
        return f"{kind} in [{low}, {high}]{unit}"


def parameter(
    default: Value,
    description: str,
    *,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: Choices | None = None,
) -> Value:
    """Declare a field of a :class:`Parameters` class.

    The annotation of the field is the type of the parameter: ``rate: float = parameter(0, ...)``
    is a float.  ``choices`` may be a function where they are known only later.
    """
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

    _types: ClassVar[dict[str, type]] = {}

    def __init_subclass__(cls) -> None:
        """Refuse declarations whose default is not of the annotated type.

        Raises
        ------
        TypeError
            Naming the class, the field, its annotation and its default.
        """
        super().__init_subclass__()
        hints = get_type_hints(cls)
        cls._types = {name: get_origin(hint) or hint for name, hint in hints.items()}
        for name, declared in list(vars(cls).items()):
            if is_declared(declared):
                _check_default(cls, name, hints[name], declared.default)

    def __post_init__(self) -> None:
        """Check every field against its declaration; raise :class:`ConfigError` on a misfit."""
        for spec in self.specs():
            value = check(spec, getattr(self, spec.name))
            object.__setattr__(self, spec.name, value)

    @classmethod
    def specs(cls, prefix: str = "") -> Iterator[ParameterSpec]:
        """Yield the declared parameters, their names prefixed with ``prefix``."""
        for item in fields(cls):
            if is_declared(item):
                kind, choices = cls._types[item.name], item.metadata["choices"]
                meta = {**item.metadata, "choices": choices() if callable(choices) else choices}
                default: Any = item.default
                default = float(default) if kind is float else default
                yield ParameterSpec(prefix + item.name, kind, default, **meta)

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


def is_declared(item: object) -> bool:
    """Return whether a field was declared with :func:`parameter`."""
    return (
        isinstance(item, Field) and "description" in item.metadata and item.default is not MISSING
    )


def check(spec: ParameterSpec, value: Any, prefix: str = "") -> Any:
    """Return ``value`` as the type of the parameter, or raise :class:`ConfigError` saying why."""
    try:
        value = _converted(spec, value)
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


def _converted(spec: ParameterSpec, value: Any) -> Any:
    """Return ``value`` as the type of ``spec``; raise TypeError or ValueError if it is not one."""
    if spec.type in (bool, str):
        if type(value) is not spec.type:
            raise TypeError
        return value
    if spec.type is tuple:
        if isinstance(value, str) or len(value) != len(spec.default):
            raise ValueError
        return tuple(float(_number(v)) for v in value)
    if spec.type is int:
        if int(_number(value)) != value:
            raise ValueError
        return int(value)
    return float(_number(value))


def _number(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise TypeError
    return value


def _check_default(cls: type, name: str, kind: Any, default: Any) -> None:
    """Raise TypeError when ``default`` is not of ``kind``, as field ``name`` is annotated."""
    if kind in SCALARS:
        fits = type(default) is kind or (kind is float and type(default) is int)
    else:
        numbers = get_origin(kind) is tuple and set(get_args(kind)) == {float}
        fits = numbers and type(default) is tuple and len(default) == len(get_args(kind))
    if not fits:
        raise TypeError(
            f"parameter {cls.__name__}.{name} is annotated {kind} and has the default "
            f"{default!r}; allowed are bool, int, float, str or a tuple of floats, and a default "
            "of that type"
        )


def _refusal(spec: ParameterSpec, value: Any, prefix: str) -> ConfigError:
    shown = list(value) if isinstance(value, tuple) else value
    return ConfigError(f"parameter '{prefix}{spec.name}' is {shown!r}; allowed is {spec.allowed}")
