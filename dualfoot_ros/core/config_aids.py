"""Parameters of the aids that combine with any method."""

from __future__ import annotations

from dataclasses import dataclass

from .parameters import Parameters, parameter


@dataclass(frozen=True)
class Aids(Parameters):
    """What else is known of a standing foot; all off unless switched on."""

    flat_floor: bool = parameter(False, "walking on one level only: height zero in stance")
    floor_std: float = parameter(
        0.01, "unevenness of the floor", unit="m", minimum=1e-4, maximum=1.0
    )
    static_std: float = parameter(
        0.02, "how far a sensor moves on a standing foot", unit="m", minimum=1e-4, maximum=1.0
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
