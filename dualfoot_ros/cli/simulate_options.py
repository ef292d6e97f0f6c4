"""The configurations that the options of ``dualfoot simulate`` give, and the list of them."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from .arguments import settings
from .printing import print_json

if TYPE_CHECKING:
    from ..simulation import (
        BarometerConfig,
        ClockConfig,
        MagnetometerConfig,
        SensorConfig,
        WalkConfig,
    )

GROUPS = ("gait", "sensor", "left_clock", "right_clock", "barometer", "magnetometer")
PLAIN = ("route", "laps", "speed", "rate", "mounting", "standing", "stops", "stop_duration")


def configurations(
    args: argparse.Namespace,
) -> tuple[WalkConfig, SensorConfig, tuple[ClockConfig, ClockConfig]]:
    """Return walk, sensor and clocks, from the options and the ``--set`` parameters.

    Raises
    ------
    ConfigError
        Naming the parameter, its value and what is allowed.
    """
    from dataclasses import asdict

    from ..core import ConfigError, nested
    from ..simulation import ClockConfig, SensorConfig, WalkConfig, grade

    given = {name: getattr(args, name) for name in PLAIN}
    walk = {name: value for name, value in given.items() if value is not None}
    walk.update(nested(settings(args)))
    groups = {name: walk.pop(name, {}) for name in GROUPS}
    for name, values in groups.items():
        if not isinstance(values, Mapping):
            raise ConfigError(f"parameter '{name}' is a group; name one of its own, see --list")
    sensor = asdict(grade(args.grade, args.errors))
    if args.increments is not None:
        sensor["increments"] = args.increments
    sensor |= groups["sensor"]
    return (
        WalkConfig.from_mapping({**walk, "gait": groups["gait"]}),
        SensorConfig.from_mapping(sensor, "sensor."),
        (
            ClockConfig.from_mapping(groups["left_clock"], "left_clock."),
            ClockConfig.from_mapping(groups["right_clock"], "right_clock."),
        ),
    )


def barometer(args: argparse.Namespace) -> BarometerConfig | None:
    """Return the barometers of ``--barometer`` and the ``--set`` parameters, or None.

    Raises
    ------
    ConfigError
        Naming the parameter, its value and what is allowed.
    """
    from ..simulation import BarometerConfig

    given = _sensor_settings(args, "barometer", args.barometer is not None)
    if args.barometer is None:
        return None
    return BarometerConfig.from_mapping({"worn": args.barometer, **given}, "barometer.")


def magnetometer(args: argparse.Namespace) -> MagnetometerConfig | None:
    """Return the magnetometers of ``--magnetometer`` and the ``--set`` parameters, or None.

    Raises
    ------
    ConfigError
        Naming the parameter, its value and what is allowed.
    """
    from ..simulation import MagnetometerConfig

    given = _sensor_settings(args, "magnetometer", args.magnetometer)
    return MagnetometerConfig.from_mapping(given, "magnetometer.") if args.magnetometer else None


def _sensor_settings(args: argparse.Namespace, name: str, present: bool) -> Mapping[str, Any]:
    """Return the ``--set`` parameters of a sensor that an option of its own switches on."""
    from ..core import ConfigError, nested

    given: Mapping[str, Any] = nested(settings(args)).get(name, {})
    if given and not present:
        first = next(iter(given))
        raise ConfigError(f"'{name}.{first}' is set without a {name}; add --{name}")
    return given


def show_choices(as_json: bool) -> int:
    """Show routes, mountings, grades and every parameter that ``--set`` takes."""
    from .. import simulation as known

    specs = [
        *known.WalkConfig.specs(),
        *known.Gait.specs("gait."),
        *known.SensorConfig.specs("sensor."),
        *known.ClockConfig.specs("left_clock."),
        *known.ClockConfig.specs("right_clock."),
        *known.BarometerConfig.specs("barometer."),
        *known.MagnetometerConfig.specs("magnetometer."),
    ]
    routes = {name: kind.description for name, kind in known.ROUTES.items()}
    if as_json:
        parameters = {
            p.name: {"default": p.default, "unit": p.unit, "allowed": p.allowed} for p in specs
        }
        print_json(
            {
                "routes": routes,
                "mountings": list(known.MOUNTS),
                "grades": list(known.GRADES),
                "parameters": parameters,
            }
        )
        return 0
    print("routes:")
    for name, text in routes.items():
        print(f"  {name:<14}{text}")
    print(f"mountings: {', '.join(known.MOUNTS)}")
    print(
        f"grades: {', '.join(known.GRADES)} (the defaults of sensor.* below are those of consumer)"
    )
    print("parameters:")
    for spec in specs:
        print(f"  {spec.name}={spec.default}  {spec.description}; {spec.allowed}")
    return 0
