"""Samples of a device as arrays, with its own time without wraps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core import FloatArray, IntArray
from ..timing import CounterConfig, Unwrapper
from .sample import Sample


@dataclass(frozen=True)
class SampleSeries:
    """Samples of one device.

    Attributes
    ----------
    device_ns : (N,) time of the device's clock, or None where it sends none
    arrival_ns : (N,) times at which the bytes were read
    specific_force, angular_rate : (N, 3) m/s^2, rad/s
    magnetic_field : (N, 3) T, or None where none was sent; nan before the first
    """

    device_ns: IntArray | None
    arrival_ns: IntArray
    specific_force: FloatArray
    angular_rate: FloatArray
    magnetic_field: FloatArray | None = None

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.arrival_ns)


def series_of(samples: Sequence[Sample], *, live: bool = True) -> SampleSeries:
    """Return ``samples`` as arrays; device time counts where every sample has it.

    The arrivals of a capture that is not ``live`` say nothing about its gaps.
    """
    fields = [sample.magnetic_field for sample in samples]
    field = None
    if any(value is not None for value in fields):
        field = np.array([value or (np.nan, np.nan, np.nan) for value in fields])
    return SampleSeries(
        _device_time(samples, live),
        np.array([sample.arrival_ns for sample in samples], dtype=np.int64),
        np.array([sample.specific_force for sample in samples]).reshape(-1, 3),
        np.array([sample.angular_rate for sample in samples]).reshape(-1, 3),
        field,
    )


def _device_time(samples: Sequence[Sample], live: bool) -> IntArray | None:
    if not samples or any(sample.ticks is None for sample in samples):
        return None
    first = samples[0]
    counter = CounterConfig(bits=str(first.tick_bits), rate=1e9 / first.tick_ns)
    unwrapper = Unwrapper(counter)
    times = [
        unwrapper.time_ns(s.ticks, s.arrival_ns if live else None)
        for s in samples
        if s.ticks is not None
    ]
    return np.array(times, dtype=np.int64)
