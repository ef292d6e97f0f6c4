"""Barometers on the walk: pressure from the true height, with noise, drift and other weather.

The standard atmosphere at another temperature is stretched by the ratio of the temperatures, so a
barometric height is wrong by that ratio, as a real one is.  The air that streams past a swinging
shoe (some 10 Pa) is left out, since heights are measured on standing feet only.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core import FloatArray, Parameters, PressureSeries, parameter
from ..core.aids import height_pressure
from .clocks import ClockConfig, sample_times
from .noise import gauss_markov

if TYPE_CHECKING:
    from .walk import Walk

STANDARD_KELVIN = 288.15
ZERO_CELSIUS = 273.15


@dataclass(frozen=True)
class BarometerConfig(Parameters):
    """Where barometers are worn, and sizes of their errors; the defaults are a phone's."""

    worn: str = parameter(
        "feet", "one on each foot (left, right), or one on the body", choices=("feet", "body")
    )
    rate: float = parameter(25.0, "sampling rate", unit="Hz", minimum=1.0, maximum=200.0)
    noise: float = parameter(
        2.0, "white noise of a sample (12 Pa are a metre)", unit="Pa", minimum=0.0, maximum=100.0
    )
    offset: float = parameter(
        50.0, "spread of the offset from sensor to sensor", unit="Pa", minimum=0.0, maximum=1e3
    )
    drift: float = parameter(
        10.0, "slow drift of sensor and weather", unit="Pa", minimum=0.0, maximum=1e3
    )
    drift_time: float = parameter(
        1800.0, "correlation time of the drift", unit="s", minimum=1.0, maximum=1e6
    )
    altitude: float = parameter(
        100.0, "of the start above sea level", unit="m", minimum=-400.0, maximum=5000.0
    )
    temperature: float = parameter(
        20.0, "of the air; the standard's is 15", unit="degC", minimum=-40.0, maximum=50.0
    )


def barometers(
    walked: Walk,
    config: BarometerConfig,
    clocks: tuple[ClockConfig, ClockConfig],
    start_ns: int,
    rngs: tuple[np.random.Generator, np.random.Generator],
) -> dict[str, PressureSeries]:
    """Return the measured pressure by "left" and "right", or by "both" for one on the body.

    On a foot it shares the clock of the inertial sensor; on the body the clock is true.
    """
    if config.worn == "body":
        return {"both": _sense(walked, config, ClockConfig(), start_ns, rngs[0], (0, 1))}
    return {
        worn: _sense(walked, config, clocks[k], start_ns, rngs[k], (k,))
        for k, worn in enumerate(("left", "right"))
    }


def _sense(
    walked: Walk,
    config: BarometerConfig,
    clock: ClockConfig,
    start_ns: int,
    rng: np.random.Generator,
    feet: tuple[int, ...],
) -> PressureSeries:
    """Return the samples of one sensor whose height is the mean of ``feet``."""
    times = sample_times(clock, config.rate, walked.duration_s, start_ns, rng)
    ends = times.edges_s[1:]
    heights = [walked.truth(foot, ends, times.stamp_ns).position[:, 2] for foot in feet]
    pressure = air_pressure(config, np.mean(heights, axis=0))
    pressure += config.offset * rng.standard_normal() + _noise(config, len(ends), rng)
    return PressureSeries(times.stamp_ns[times.kept], pressure[times.kept])


def air_pressure(config: BarometerConfig, height_m: FloatArray) -> FloatArray:
    """Return the true pressure (N,) Pa at heights (N,) m above the start."""
    shrunk = height_m * STANDARD_KELVIN / (ZERO_CELSIUS + config.temperature)
    return np.array([height_pressure(h) for h in (config.altitude + shrunk).tolist()])


def _noise(config: BarometerConfig, count: int, rng: np.random.Generator) -> FloatArray:
    """Return white noise and a first-order Gauss-Markov drift (N,), Pa."""
    white = config.noise * rng.standard_normal(count)
    keep = np.exp(-1.0 / (config.rate * config.drift_time))
    noise: FloatArray = white + config.drift * gauss_markov(keep, rng.standard_normal(count))
    return noise
