"""The gate of one stream: lets samples in whose stamps increase and whose values are finite."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core import BoolArray, FloatArray, ImuSeries, Refusal, row_blocks
from .pairing_config import AlignerConfig

INFINITE = 1e100  # no reading in any unit, and its square may overflow

REFUSALS = (Refusal.NOT_FINITE, Refusal.DUPLICATE, Refusal.OUT_OF_ORDER)
COUNTERS: tuple[str, ...] = ("accepted", *REFUSALS, Refusal.GAP)


class Gate:
    """Admit or refuse the samples of one foot, and count why.

    ``counters`` holds ``accepted``, ``not_finite``, ``duplicate`` (a stamp within the tolerance
    of the newest), ``out_of_order`` (an older stamp) and ``gap`` (admitted, but more than
    ``max_gap`` after the one before).
    """

    def __init__(self, config: AlignerConfig) -> None:
        self._gap_ns = config.max_gap_ns
        self._tolerance_ns = config.tolerance_ns
        self._restart_after = config.restart_after
        self.counters = dict.fromkeys(COUNTERS, 0)
        self.forget()

    def forget(self) -> None:
        """Take the next sample as the first; the counters stay."""
        self._newest: int | None = None
        self._previous = 0
        self._backward = 0

    @property
    def backward(self) -> int:
        """Samples in a row that are older than the newest, each newer than the one before it."""
        return self._backward

    @property
    def restarted(self) -> bool:
        """Whether the stream went on at an older time: too many samples refused in a row.

        A bag that loops does that, a device that is switched on again, and a single stamp that
        was far in the future.
        """
        return self._backward >= self._restart_after

    def refusal(self, stamp_ns: int, finite: bool) -> Refusal | None:
        """Return None for a sample that is let in, else why it is refused."""
        reason = self._judge(stamp_ns, finite)
        self.counters[reason or "accepted"] += 1
        if reason is None:
            self._newest = stamp_ns
        return reason

    def _judge(self, stamp_ns: int, finite: bool) -> Refusal | None:
        if not finite:
            return Refusal.NOT_FINITE
        if self._newest is None:
            return None
        step = stamp_ns - self._newest
        if step > self._tolerance_ns:
            self._backward = 0
            self.counters[Refusal.GAP] += step > self._gap_ns
            return None
        if step >= -self._tolerance_ns:
            return Refusal.DUPLICATE
        # An increasing run of old stamps is a stream that began anew; a late sample is alone.
        self._backward = self._backward + 1 if stamp_ns > self._previous else 1
        self._previous = stamp_ns
        return Refusal.OUT_OF_ORDER


def all_finite(values: list[float]) -> bool:
    """Tell whether every number is finite, and so is its square."""
    return all(-INFINITE < value < INFINITE for value in values)


def finite_samples(series: ImuSeries) -> BoolArray:
    """Return (N,) where all numbers of a sample are finite, and so are their squares."""
    finite = np.ones(len(series), dtype=bool)
    for part in row_blocks(len(series)):
        for values in (series.specific_force[part], series.angular_rate[part]):
            if not _are_finite(values):  # seldom, so that each is looked at then only
                finite[part] &= (np.abs(values) < INFINITE).all(axis=1)
    return finite


def _are_finite(values: FloatArray) -> bool:
    return bool(values.max() < INFINITE and values.min() > -INFINITE)  # false for nan


class Clean(NamedTuple):
    """What is left of a series.

    ``counters`` are those of :class:`dualfoot_ros.timing.pairing.stream_gate.Gate`;
    ``restart_at`` is the sample at which it was clear that the stamps had jumped back for good
    (nothing from there on is in the series), or None.
    """

    series: ImuSeries
    counters: dict[str, int]
    restart_at: int | None


def clean(series: ImuSeries, config: AlignerConfig | None = None) -> Clean:
    """Return the samples with increasing stamps and finite values, as the live aligner admits."""
    config = config or AlignerConfig()
    gate = Gate(config)
    finite = finite_samples(series)
    steps = np.diff(series.stamp_ns)
    if finite.all() and (steps > config.tolerance_ns).all():
        gate.counters["accepted"] = len(series)
        gate.counters[Refusal.GAP] = int((steps > config.max_gap_ns).sum())
        return Clean(series, gate.counters, None)
    keep = np.zeros(len(series), dtype=bool)
    for i, (stamp_ns, good) in enumerate(zip(series.stamp_ns.tolist(), finite, strict=True)):
        keep[i] = gate.refusal(stamp_ns, bool(good)) is None
        if gate.restarted:
            return Clean(series[keep], gate.counters, i)
    return Clean(series[keep], gate.counters, None)
