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
