"""When samples reach the host: the delays of a Bluetooth Low Energy link.

A device gathers some samples into one notification.  It leaves at the next connection event, the
events being a fixed interval apart on the host's radio; an event may fail, and then the next one
carries it.  Now and then the radio is busy with something else for a while (a stall).  At last the
host takes its time to hand it over: mostly little, at times much (a Pareto tail).

Where the time between notifications is a multiple of the connection interval, or nearly so, the
delay stays the same for a long time and then slips by the interval: only the skew moves it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, IntArray, Parameters, parameter


@dataclass(frozen=True)
class BleLinkConfig(Parameters):
    """One link; the defaults are usual for a phone or a laptop."""

    interval: float = parameter(
        0.03, "between connection events", unit="s", minimum=0.0075, maximum=4.0
    )
    burst: int = parameter(10, "samples a notification", minimum=1, maximum=100)
    least: float = parameter(
        0.004, "delay that is always there", unit="s", minimum=0.0, maximum=1.0
    )
    handling: float = parameter(
        0.0002,
        "mean time each of device and host usually takes to hand over",
        unit="s",
        minimum=0.0,
        maximum=0.1,
    )
    failure: float = parameter(
        0.1, "share of the connection events that fail", minimum=0.0, maximum=0.95
    )
    stall: float = parameter(0.1, "length of a stall", unit="s", minimum=0.0, maximum=10.0)
    stall_period: float = parameter(
        3.0, "mean time between stalls", unit="s", minimum=0.1, maximum=1e6
    )
    tail_share: float = parameter(
        0.1, "share of the notifications the host is slow with", minimum=0.0, maximum=1.0
    )
    tail: float = parameter(
        0.003, "scale of that Pareto delay", unit="s", minimum=0.0, maximum=0.1
    )
    tail_shape: float = parameter(
        1.5, "exponent of its tail; smaller is heavier", minimum=0.5, maximum=10.0
    )


def arrivals(link: BleLinkConfig, sampled_ns: IntArray, rng: np.random.Generator) -> IntArray:
    """Return the (N,) ns at which samples taken at ``sampled_ns`` (N,) reach the host.

    Both are of the host's clock and never decrease; no sample arrives before it was taken.
    """
    if len(sampled_ns) == 0:
        return np.empty(0, dtype=np.int64)
    start = int(sampled_ns[0])
    last = np.append(np.arange(link.burst - 1, len(sampled_ns) - 1, link.burst), -1)
    ready = (sampled_ns[last] - start) * 1e-9
    count = len(ready)
    ready = ready + link.handling * rng.exponential(size=count)
    sent = _events(link, ready, float(rng.uniform(0.0, link.interval)), rng)
    slow = link.tail * rng.pareto(link.tail_shape, count) * (rng.random(count) < link.tail_share)
    handed = sent + link.least + link.handling * rng.exponential(size=count) + slow
    received = start + np.ceil(np.maximum.accumulate(handed) * 1e9).astype(np.int64)
    packet = np.minimum(np.arange(len(sampled_ns)) // link.burst, count - 1)
    return received[packet]


def _events(
    link: BleLinkConfig, ready: FloatArray, phase: float, rng: np.random.Generator
) -> FloatArray:
    """Return the time (s) of the connection event that carries each notification."""
    failed = rng.geometric(1.0 - link.failure, len(ready)) - 1
    event = _next_event(link, ready, phase) + failed * link.interval
    until = float(event[-1]) + 10.0 * link.stall_period
    gaps = rng.exponential(link.stall_period, 2 * int(until / link.stall_period) + 20)
    begin = np.cumsum(gaps + link.stall)
    stall = np.searchsorted(begin, event, side="right") - 1
    over = np.where(stall >= 0, begin[np.maximum(stall, 0)] + link.stall, -np.inf)
    event = np.where(event < over, _next_event(link, over, phase), event)
    return np.maximum.accumulate(event)


def _next_event(link: BleLinkConfig, time_s: FloatArray, phase: float) -> FloatArray:
    return phase + link.interval * np.ceil((time_s - phase) / link.interval)
