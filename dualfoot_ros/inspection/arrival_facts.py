"""The first seconds of a sensor in figures, and advice on what to change: live and for probing."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core import DEGREE, STANDARD_GRAVITY, FloatArray, IntArray

LEAST_SAMPLES = 20
STILL = 0.03  # of the mean specific force; a sensor that scatters less is at rest
UPRIGHT = 0.9  # share of gravity on one axis that makes it the upward one
UNIT_TOLERANCE = 0.2
FORCE_SIZES = {"m/s^2": STANDARD_GRAVITY, "g": 1.0, "mg": 1000.0}
NO_GRAVITY = 2.0  # m/s^2
FASTEST = 35.0  # rad/s, 2000 deg/s
LARGEST_BIAS = 0.2  # rad/s at rest; a gyro that reads more is in deg/s, or broken
SLOW_HZ = 50.0
FAST_HZ = 2500.0  # faster than any sensor of a foot
JITTER_SHARE = 0.3  # of the sampling interval
AXES_FOR_UP = {
    "-z": "x,-y,-z",
    "+y": "x,-z,y",
    "-y": "x,z,-y",
    "+x": "y,z,x",
    "-x": "y,-z,-x",
}
"""Axes forward, left, up for a sensor whose axis points up; forward is a guess."""


class ArrivalFacts(NamedTuple):
    """What a sensor sends.

    Attributes
    ----------
    samples : number of them
    rate_hz : from the mean interval of the stamps
    jitter_s : 95 % of the intervals of the stamps differ from the median by less
    force, rate : (3,) means, in the units that come
    high_rate : 98 % quantile of |angular rate|
    still : whether the sensor is at rest
    device_time : whether it sends the time of its own clock
    """

    samples: int
    rate_hz: float
    jitter_s: float
    force: tuple[float, float, float]
    rate: tuple[float, float, float]
    high_rate: float
    still: bool
    device_time: bool

    @property
    def force_norm(self) -> float:
        """Norm of the mean specific force."""
        return math.hypot(*self.force)

    @property
    def up(self) -> str | None:
        """Axis of the sensor that points up, as in "+z"; None in motion or at a slant."""
        if not self.still or not self.force_norm:
            return None
        k = max(range(3), key=lambda i: abs(self.force[i]))
        if abs(self.force[k]) < UPRIGHT * self.force_norm:
            return None
        return f"{'+' if self.force[k] > 0 else '-'}{'xyz'[k]}"

    @property
    def axes(self) -> str | None:
        """Axes forward, left, up that put the upward axis right; None where they are right."""
        return AXES_FOR_UP.get(self.up or "")

    @property
    def force_unit(self) -> str | None:
        """Unit in which the specific force is gravity; None where it is in none."""
        for unit, size in FORCE_SIZES.items():
            if abs(self.force_norm / size - 1.0) < UNIT_TOLERANCE:
                return unit
        return None

    @property
    def in_degrees(self) -> bool:
        """Whether the angular rate can only be in deg/s."""
        at_rest = math.hypot(*self.rate)
        return self.high_rate > FASTEST or (self.still and at_rest > LARGEST_BIAS)


def arrival_facts(
    stamp_ns: IntArray, force: FloatArray, rate: FloatArray, device_time: bool
) -> ArrivalFacts:
    """Return the facts of samples (N, 3) with the stamps (N,); N is at least 2."""
    steps = np.diff(stamp_ns)
    span_s = 1e-9 * float(stamp_ns[-1] - stamp_ns[0])
    norms = np.linalg.norm(force, axis=1)
    still = float(np.std(norms)) < STILL * float(np.mean(norms))
    fx, fy, fz = np.mean(force, axis=0).tolist()
    wx, wy, wz = np.mean(rate, axis=0).tolist()
    return ArrivalFacts(
        samples=len(stamp_ns),
        rate_hz=len(steps) / span_s if span_s > 0.0 else math.nan,
        jitter_s=1e-9 * float(np.quantile(np.abs(steps - np.median(steps)), 0.95)),
        force=(fx, fy, fz),
        rate=(wx, wy, wz),
        high_rate=float(np.quantile(np.linalg.norm(rate, axis=1), 0.98)),
        still=still,
        device_time=device_time,
    )


def describe_arrival(
    facts: ArrivalFacts, clocks: tuple[str, str] = ("its own clock", "no clock of its own")
) -> str:
    """Return rate, clock, gravity and axes in one line.

    ``clocks`` are the words for samples with time of their own and for those without.
    """
    clock = clocks[0] if facts.device_time else clocks[1]
    state = "at rest" if facts.still else "in motion"
    up = f", {facts.up} up" if facts.up else ""
    return (
        f"{_describe_rate(facts)}, {clock}; {state}: specific force {facts.force_norm:.3g}{up}, "
        f"angular rate {math.hypot(*facts.rate):.2g}"
    )


def _describe_rate(facts: ArrivalFacts) -> str:
    if math.isnan(facts.rate_hz):
        return "rate unknown"
    return f"{facts.rate_hz:.1f} Hz, jitter {1e3 * facts.jitter_s:.1f} ms"


def advice_on(facts: ArrivalFacts, *, units_known: bool = False) -> dict[str, str]:
    """Return what to change, a sentence by the parameter of ``imu_adapter`` it is about.

    ``units_known`` says that the format of the device fixes the unit of the angular rate.
    """
    return {
        **_force_advice(facts),
        **({} if units_known else _rate_advice(facts)),
        **_axes_advice(facts),
        **_sampling_advice(facts),
    }


def _force_advice(facts: ArrivalFacts) -> dict[str, str]:
    size = facts.force_norm
    if facts.force_unit == "m/s^2" or (not facts.still and size > NO_GRAVITY):
        return {}
    if facts.force_unit == "g":
        return {"units.specific_force": "set it to g"}
    if facts.force_unit is None and size < NO_GRAVITY:
        text = "gravity is taken out; let the device send the raw acceleration"
        return {"units.specific_force": text}
    text = (
        f"the specific force is {size:.3g} at rest where {STANDARD_GRAVITY:.1f} m/s^2 is due; "
        "check the range and the unit that the device is set to"
    )
    return {"units.specific_force": text}


def _rate_advice(facts: ArrivalFacts) -> dict[str, str]:
    if not facts.in_degrees:
        return {}
    at_rest = math.hypot(*facts.rate)
    return {
        "units.angular_rate": f"set it to deg/s: the rate is {max(at_rest, facts.high_rate):.3g}, "
        f"which in rad/s would be {at_rest / DEGREE:.0f} deg/s"
        if facts.still
        else f"set it to deg/s: the rate exceeds {FASTEST:g}"
    }


def _axes_advice(facts: ArrivalFacts) -> dict[str, str]:
    axes = facts.axes
    if axes is None:
        return {}
    text = f"set them to {axes} if the sensor is as on the foot now ({facts.up} is up), and its "
    return {"mounting.axes": f"{text}{axes.partition(',')[0]} axis points forward"}


def _sampling_advice(facts: ArrivalFacts) -> dict[str, str]:
    advice = {}
    if facts.rate_hz < SLOW_HZ:
        text = f"the device sends {facts.rate_hz:.0f} samples a second; set it to 100 or more"
        advice["checks.rate"] = text
    if facts.rate_hz > FAST_HZ:
        advice["source"] = (
            f"{facts.rate_hz:.0f} samples a second cannot be, so the ticks of its clock are "
            "longer than they are taken for; set the device to the clock that the format has, or "
            "leave out format= of a table"
        )
    if facts.jitter_s * facts.rate_hz > JITTER_SHARE:
        text = "the stamps are times of arrival; let the device send its own time" + (
            ", or set stamp to device where the header has it" if facts.device_time else ""
        )
        advice["stamp"] = text
    return advice
