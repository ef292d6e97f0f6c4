"""Parameters of what helps beside the feet: barometers, field, floors, straight lines."""

from __future__ import annotations

from dataclasses import dataclass

from ..parameters import Parameters, parameter


@dataclass(frozen=True)
class AidsConfig(Parameters):
    """What else is known of a standing foot; all off unless switched on."""

    flat_floor: bool = parameter(False, "walking on one level only: height zero in stance")
    floor_std: float = parameter(
        0.01, "unevenness of the floor", unit="m", minimum=1e-4, maximum=1.0
    )
    static_std: float = parameter(
        0.0,
        "flat_floor: how far a sensor moves on a standing foot (0: its place is no measurement); "
        "as in the paper, whose place is taken for known, so that the covariance is too small",
        unit="m",
        minimum=0.0,
        maximum=1.0,
    )
    barometer: bool = parameter(False, "height from air pressure in stance")
    barometer_std: float = parameter(
        0.3, "noise of a stance's mean pressure height", unit="m", minimum=1e-3, maximum=100.0
    )
    barometer_samples: int = parameter(
        3, "pressure samples needed in a stance", minimum=1, maximum=1000
    )
    magnetic_heading: bool = parameter(
        False, "heading from the magnetic field in stance, against that on the first stances"
    )
    magnetic_std: float = parameter(
        0.35,
        "error of the field's direction; what iron on the foot does to it repeats itself",
        unit="rad",
        minimum=0.01,
        maximum=3.0,
    )
    magnetic_iron_std: float = parameter(
        0.2,
        "the same once the walk has turned and the iron is learnt",
        unit="rad",
        minimum=0.01,
        maximum=3.0,
    )
    magnetic_size: float = parameter(
        0.06,
        "share by which the field's size may differ from the reference's",
        minimum=0.001,
        maximum=10.0,
    )
    magnetic_dip: float = parameter(
        0.07,
        "by how much its dip may differ from the reference's",
        unit="rad",
        minimum=0.001,
        maximum=3.2,
    )
    magnetic_stances: int = parameter(
        4, "stances in a row that must agree to be the reference", minimum=2, maximum=100
    )
    straight_lines: bool = parameter(
        False, "heading from straight walking: straights keep their direction and are parallel"
    )
    straight_strides: int = parameter(
        12, "strides of a foot in a row that make a straight", minimum=4, maximum=100
    )
    straight_bend: float = parameter(
        0.026,
        "by how much the halves of a straight may differ in direction",
        unit="rad",
        minimum=1e-3,
        maximum=0.5,
    )
    straight_gate: float = parameter(
        0.087,
        "by how much a straight may differ from one to which it is parallel",
        unit="rad",
        minimum=1e-3,
        maximum=0.7,
    )
    straight_std: float = parameter(
        0.05, "error of the direction of a straight", unit="rad", minimum=1e-3, maximum=1.0
    )
    straight_clip: float = parameter(
        0.0011,
        "by how much four strides on a straight turn the heading at most",
        unit="rad",
        minimum=1e-4,
        maximum=1.0,
    )
