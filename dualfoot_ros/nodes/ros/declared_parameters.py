"""Declaration of ROS parameters: types, ranges, descriptions, and warnings of misspelt names."""

from __future__ import annotations

import difflib
import textwrap
from collections.abc import Collection, Iterable, Mapping
from typing import Any, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
)
from rclpy.node import Node

from ...core import GROUPS, METHODS, Parameters, ParameterSpec, all_specs, check
from ...settings import node_parameter_names, reason_read_only

Group = TypeVar("Group", bound=Parameters)
COLUMNS = 99
OF_RCLPY = ("use_sim_time", "start_type_description_service")


def declare(
    node: Node, specs: Iterable[ParameterSpec], live: Collection[str] = ()
) -> dict[str, Any]:
    """Declare parameters on ``node`` and return the values they have been given.

    Those named in ``live`` may change while the node runs, the others are read-only.

    A whole number is accepted for a real one.  Overrides that no node of the package knows are
    warned of; the effective configuration is logged once.

    Raises
    ------
    ConfigError
        When a value has the wrong type or is out of its range.
    """
    overrides = node._parameter_overrides  # noqa: SLF001  (rclpy shows only what is declared)
    given = {name: parameter.value for name, parameter in overrides.items()}
    values = {}
    for spec in specs:
        value = check(spec, given.get(spec.name, spec.default))
        plain = list(value) if isinstance(value, tuple) else value
        node.declare_parameter(
            spec.name, plain, descriptor(spec, spec.name in live), ignore_override=True
        )
        values[spec.name] = value
    for name in given:
        _warn_if_unknown(node, name, values)
    node.get_logger().info("configuration:\n" + _format(values))
    return values


def group(cls: type[Group], values: Mapping[str, Any], prefix: str = "") -> Group:
    """Return the part of ``values`` that a parameter group declares."""
    return cls(**{spec.name: values[prefix + spec.name] for spec in cls.specs()})


def descriptor(spec: ParameterSpec, live: bool = False) -> ParameterDescriptor:
    """Return description, range and constraint of a parameter as ROS shows them.

    ``live`` says that it may change while the node runs; where not, the constraint says why.
    """
    fixed = f"; read-only: {reason_read_only(spec.name)}"
    described = ParameterDescriptor(
        name=spec.name,
        description=spec.description,
        additional_constraints=spec.allowed + ("" if live else fixed),
        read_only=not live,
    )
    if spec.minimum is None or spec.maximum is None:
        return described
    if spec.type is float:
        described.floating_point_range = [
            FloatingPointRange(from_value=float(spec.minimum), to_value=float(spec.maximum))
        ]
    elif spec.type is int:
        described.integer_range = [
            IntegerRange(from_value=int(spec.minimum), to_value=int(spec.maximum), step=1)
        ]
    return described


def _warn_if_unknown(node: Node, name: str, own: Mapping[str, Any]) -> None:
    known = {*own, *node_parameter_names(), *(spec.name for spec in all_specs()), *OF_RCLPY}
    if name in known or name.startswith("qos_overrides."):
        return
    near = difflib.get_close_matches(name, sorted(known), n=1)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    node.get_logger().warning(f"parameter '{name}' is not known and has no effect{hint}")


def _format(values: Mapping[str, Any]) -> str:
    """Return the values as text, a line or more a group, without methods that are not in use."""
    idle = set(METHODS) - {values.get("method"), *GROUPS}
    groups: dict[str, list[str]] = {}
    for name, value in values.items():
        if name.partition(".")[0] not in idle:
            groups.setdefault(name.rpartition(".")[0], []).append(f"{name}={value}")
    lines = (
        textwrap.wrap(
            ", ".join(items),
            COLUMNS,
            initial_indent="  ",
            subsequent_indent="    ",
            break_long_words=False,
            break_on_hyphens=False,
        )
        for items in groups.values()
    )
    return "\n".join(line for wrapped in lines for line in wrapped)
