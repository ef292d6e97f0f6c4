"""Parameters of a simulated walk: the route, the walker, and the mounting of the sensors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from ..core import STANDARD_GRAVITY, FloatArray, Parameters, parameter
from .routes import ROUTES
from .shoe import rotation_zyx


@dataclass(frozen=True)
class Mount:
    """Where the sensor sits on the shoe.

    Attributes
    ----------
    lever : (3,) m from the ball of the foot (forward, outward, up)
    degrees : roll outward, pitch nose-down, yaw outward of the sensor against the shoe
    min_distance : usual least distance of the two sensors in passing, m
    """

    lever: tuple[float, float, float]
    degrees: tuple[float, float, float]
    min_distance: float

    def lever_of(self, side: int) -> FloatArray:
        """Return the (3,) lever arm in the shoe (forward-left-up); side +1 left, -1 right."""
        return np.array(self.lever) * [1.0, side, 1.0]

    def rotation_of(self, side: int) -> FloatArray:
        """Return the (3, 3) rotation sensor to shoe, yaw-pitch-roll; side +1 left, -1 right."""
        roll, pitch, yaw = np.radians(self.degrees)
        rotation: FloatArray = rotation_zyx(
            np.array([yaw * side]), np.array([pitch]), np.array([-roll * side])
        )[0]
        return rotation


MOUNTS = {
    "instep": Mount((-0.08, 0.01, 0.09), (8.0, 28.0, 3.0), 0.15),
    "heel": Mount((-0.20, 0.02, 0.06), (3.0, -12.0, 2.0), 0.20),
}


@dataclass(frozen=True)
class Gait(Parameters):
    """Parameters of the gait, and their variation from step to step."""

    walk_ratio: float = parameter(
        0.0065, "step length over cadence", unit="m min", minimum=0.002, maximum=0.02
    )
    stance_share: float = parameter(
        0.325, "share of the cycle in which the foot stands", minimum=0.2, maximum=0.45
    )
    stance_share_std: float = parameter(
        0.012, "its spread from step to step", minimum=0.0, maximum=0.05
    )
    kappa: float = parameter(
        0.56, "moment of least distance within the stance", minimum=0.3, maximum=0.8
    )
    kappa_std: float = parameter(0.02, "its spread from step to step", minimum=0.0, maximum=0.1)
    min_distance: float = parameter(
        0.0,
        "mean least distance of the sensors in passing (0: usual for the mounting)",
        unit="m",
        minimum=0.0,
        maximum=0.5,
    )
    min_distance_std: float = parameter(
        0.02, "its spread from step to step", unit="m", minimum=0.0, maximum=0.1
    )
    turn_widening: float = parameter(
        0.10,
        "more distance per turn within a step",
        unit="m/rad",
        minimum=0.0,
        maximum=1.0,
    )
    step_width: float = parameter(
        0.12, "lateral distance of the footprints", unit="m", minimum=0.04, maximum=0.4
    )
    standing_width: float = parameter(
        0.18, "lateral distance of the standing feet", unit="m", minimum=0.08, maximum=0.5
    )
    footprint_std: float = parameter(
        0.02,
        "spread of the footprints, along (half of it across)",
        unit="m",
        minimum=0.0,
        maximum=0.05,
    )
    cycle_std: float = parameter(
        0.015, "relative spread of the step times", minimum=0.0, maximum=0.1
    )
    shape_std: float = parameter(
        0.06, "relative spread of the swing's rotation and lift", minimum=0.0, maximum=0.2
    )
    coning: float = parameter(
        1.0,
        "how much the swinging foot cones: 1 as real feet do, 0 the shapes of version 0.1",
        minimum=0.0,
        maximum=1.5,
    )
    clearance: float = parameter(
        0.05, "lift of the ball of the swinging foot", unit="m", minimum=0.0, maximum=0.2
    )
    toe_out: float = parameter(
        0.10, "outward angle of the feet", unit="rad", minimum=-0.3, maximum=0.5
    )
    roll_over: float = parameter(
        0.06, "forward rotation during the stance", unit="rad", minimum=0.0, maximum=0.3
    )
    wobble: float = parameter(
        0.15,
        "random angular rate about each axis in stance",
        unit="rad/s",
        minimum=0.0,
        maximum=1.0,
    )
    sway: float = parameter(
        0.003, "slow random rotation of the standing feet", unit="rad", minimum=0.0, maximum=0.05
    )
    tremor: float = parameter(
        0.003, "random angular rate of the standing feet", unit="rad/s", minimum=0.0, maximum=0.1
    )
    impact: float = parameter(
        0.002, "ringing of the shoe at heel strike", unit="m", minimum=0.0, maximum=0.01
    )


@dataclass(frozen=True)
class WalkConfig(Parameters):
    """The way and the walker."""

    route: str = parameter("rectangle", "where to walk", choices=tuple(ROUTES))
    laps: int = parameter(1, "how often, on a closed route", minimum=1, maximum=100)
    speed: float = parameter(1.2, "walking speed", unit="m/s", minimum=0.3, maximum=2.2)
    rate: float = parameter(100.0, "sampling rate", unit="Hz", minimum=60.0, maximum=400.0)
    mounting: str = parameter("instep", "where the sensors sit", choices=tuple(MOUNTS))
    standing: float = parameter(
        10.0, "standstill at the start", unit="s", minimum=0.0, maximum=7200.0
    )
    final_standing: float = parameter(
        5.0, "standstill at the end", unit="s", minimum=0.5, maximum=7200.0
    )
    stops: int = parameter(0, "stops on the way, evenly spaced", minimum=0, maximum=1000)
    stop_duration: float = parameter(4.0, "length of a stop", unit="s", minimum=0.5, maximum=600.0)
    gravity: float = parameter(
        STANDARD_GRAVITY, "local gravity", unit="m/s^2", minimum=9.7, maximum=9.9
    )
    gait: Gait = field(default_factory=Gait)

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any], prefix: str = "") -> Self:
        """Build from plain values; ``gait`` is a mapping of its own."""
        values = dict(mapping)
        gait = Gait.from_mapping(values.pop("gait", {}), f"{prefix}gait.")
        plain = {spec.name for spec in cls.specs()}
        base = super().from_mapping(values, prefix)
        return cls(**{name: getattr(base, name) for name in plain}, gait=gait)

    @property
    def mount(self) -> Mount:
        """Where the sensors sit."""
        return MOUNTS[self.mounting]

    @property
    def min_distance(self) -> float:
        """Mean least distance of the sensors in passing, m."""
        return self.gait.min_distance or self.mount.min_distance

    @property
    def step_length(self) -> float:
        """Mean step length in m: speed = step x cadence, step = walk ratio x cadence."""
        return math.sqrt(60.0 * self.gait.walk_ratio * self.speed)

    @property
    def cycle_s(self) -> float:
        """Mean duration of a gait cycle (two steps) in s."""
        return 2.0 * self.step_length / self.speed
