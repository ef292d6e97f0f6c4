"""The clock and the link of a device: sampling times, stamps, lost samples, arrival times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, IntArray, Parameters, parameter


@dataclass(frozen=True)
class ClockConfig(Parameters):
    """Clock and link of one device; the defaults are a perfect clock and a perfect link."""

    offset: float = parameter(
        0.0, "device minus true time at the start", unit="s", minimum=-1e6, maximum=1e6
    )
    drift: float = parameter(
        0.0, "how much faster the device's clock runs", unit="ppm", minimum=-1e5, maximum=1e5
    )
    phase: float = parameter(
        0.0, "first sample later by this share of the interval", minimum=0.0, maximum=1.0
    )
    jitter: float = parameter(0.0, "scatter of the stamps", unit="s", minimum=0.0, maximum=1.0)
    drops: float = parameter(0.0, "share of the samples that are lost", minimum=0.0, maximum=0.9)
    drop_burst: float = parameter(
        1.0, "mean number of samples lost at a time", minimum=1.0, maximum=1e4
    )
    delay: float = parameter(
        0.0, "least time from sample to arrival", unit="s", minimum=0.0, maximum=60.0
    )
    delay_tail: float = parameter(
        0.0, "mean of the exponential tail of the delay", unit="s", minimum=0.0, maximum=10.0
    )
    connection_interval: float = parameter(
        0.0,
        "samples arrive only at multiples of this (0: any time)",
        unit="s",
        minimum=0.0,
        maximum=10.0,
    )


@dataclass(frozen=True)
class Sampling:
    """When one device sampled.

    Attributes
    ----------
    edges_s : (N + 1,) s of true time; sample k covers the interval from edge k to edge k + 1
    stamp_ns : (N,) ns of the device's clock at the end of each interval
    arrival_ns : (N,) ns of true time, never decreasing
    kept : (N,) bool, False where the sample was lost
    """

    edges_s: FloatArray
    stamp_ns: IntArray
    arrival_ns: IntArray
    kept: np.ndarray

    def true_ns(self, start_ns: int) -> IntArray:
        """Return the (N,) ns of true time at the end of each interval."""
        return start_ns + np.round(self.edges_s[1:] * 1e9).astype(np.int64)


def sample_times(
    config: ClockConfig,
    rate_hz: float,
    duration_s: float,
    start_ns: int,
    rng: np.random.Generator,
) -> Sampling:
    """Return when a device of that nominal rate samples within ``duration_s`` of true time."""
    speed = float(1.0 + 1e-6 * config.drift)
    interval = 1.0 / (rate_hz * speed)
    count = int(np.floor(duration_s / interval - config.phase + 1e-9))
    edges: FloatArray = interval * (config.phase + np.arange(count + 1, dtype=np.float64))
    device = config.offset + speed * edges[1:] + config.jitter * rng.standard_normal(count)
    delay = config.delay + config.delay_tail * rng.exponential(size=count)
    arrival = edges[1:] + delay
    if config.connection_interval > 0.0:
        arrival = np.ceil(arrival / config.connection_interval) * config.connection_interval
    return Sampling(
        edges_s=edges,
        stamp_ns=start_ns + np.round(device * 1e9).astype(np.int64),
        arrival_ns=start_ns + np.round(np.maximum.accumulate(arrival) * 1e9).astype(np.int64),
        kept=_kept(config, count, rng),
    )


def _kept(config: ClockConfig, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return the mask of samples that were not lost; losses come in geometric bursts."""
    start = config.drops / ((1.0 - config.drops) * config.drop_burst)
    begins = rng.random(count) < min(start, 1.0)
    lengths = rng.geometric(1.0 / config.drop_burst, count) * begins
    until = np.maximum.accumulate(np.arange(count) + lengths)
    return np.arange(count) >= until
