"""The samples of one recording that pass the gate, and what became of the others."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.samples.series import ImuSeries
from .pairing.pairing_config import Sync
from .pairing.stream_gate import Gate


class Clean(NamedTuple):
    """What is left of a series.

    ``counters`` are those of :class:`dualfoot_ros.timing.pairing.stream_gate.Gate`;
    ``restart_at`` is the sample at which it was clear that the stamps had jumped back for good
    (nothing from there on is in the series), or None.
    """

    series: ImuSeries
    counters: dict[str, int]
    restart_at: int | None


def clean(series: ImuSeries, config: Sync | None = None) -> Clean:
    """Return the samples with increasing stamps and finite values, as the live aligner admits."""
    config = config or Sync()
    gate = Gate(config)
    values = np.hstack([series.specific_force, series.angular_rate])
    finite = np.asarray(np.isfinite(values).all(axis=1))
    steps = np.diff(series.stamp_ns)
    if finite.all() and (steps > config.tolerance_ns).all():
        gate.counters["accepted"] = len(series)
        gate.counters["gap"] = int((steps > config.max_gap_ns).sum())
        return Clean(series, gate.counters, None)
    keep = np.zeros(len(series), dtype=bool)
    for i, (stamp_ns, good) in enumerate(zip(series.stamp_ns.tolist(), finite, strict=True)):
        keep[i] = gate.refusal(stamp_ns, bool(good)) is None
        if gate.restarted:
            return Clean(series[keep], gate.counters, i)
    return Clean(series[keep], gate.counters, None)
