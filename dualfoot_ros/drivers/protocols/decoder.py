"""Interface of the decoders, and the parts that they share.

A decoder takes bytes as they come and gives samples.  It never raises for data, counts everything
that it refuses, keeps at most ``max_buffer`` bytes between calls, and after any garbage is back in
step with the second valid frame at the latest.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from ...core import Parameters, Refusal, Vector, parameter
from ..sample import Sample, is_finite

REFUSALS = (
    Refusal.GARBAGE_BYTES,
    Refusal.BAD_CHECKSUM,
    Refusal.MALFORMED,
    Refusal.NOT_FINITE,
    Refusal.INCOMPLETE,
    Refusal.OTHER,
    Refusal.LOST,
    Refusal.REPEATED,
)
COUNTERS: Mapping[str, str] = {
    "bytes": "bytes handed to the decoder",
    "samples": "samples delivered",
    **{str(reason): reason.words for reason in REFUSALS},
}
"""Counters of a decoder and what they count; one that is absent is 0."""


class Decoder(Protocol):
    """Bytes in, samples out; never raises for data."""

    counters: Counter[str]
    max_buffer: int
    message_oriented: bool
    """True when every call of ``feed`` must bring exactly one message of the transport."""

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Take the next bytes, read at ``arrival_ns`` (host's wall clock); return samples."""
        ...

    def reset(self) -> None:
        """Forget a half-received frame, because the link was lost; counters stay."""
        ...

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        ...


@dataclass(frozen=True)
class FieldConfig(Parameters):
    """Options of a decoder whose device sends the magnetic field in a unit of its own."""

    field_unit: float = parameter(
        0.0,
        "T for 1 in the device's arbitrary unit; 0 leaves the magnetic field out",
        unit="T",
        minimum=0.0,
        maximum=1e-3,
    )


class PacketCounter:
    """Counts of lost and repeated packets, from a counter of ``bits`` bits that wraps."""

    def __init__(self, counters: Counter[str], bits: int) -> None:
        """Count in ``counters``."""
        self._counters = counters
        self._modulus = 1 << bits
        self._last: int | None = None

    def count(self, counter: int) -> None:
        """Take the counter of the next packet; a step of more than half the range is a restart."""
        if self._last is not None:
            step = (counter - self._last) % self._modulus
            if step == 0:
                self._counters[Refusal.REPEATED] += 1
            elif step <= self._modulus // 2:
                self._counters[Refusal.LOST] += step - 1
        self._last = counter

    def reset(self) -> None:
        """Forget the last counter, so that a new connection is no loss."""
        self._last = None


def append_if_finite(counters: Counter[str], samples: list[Sample], sample: Sample) -> bool:
    """Append ``sample`` and count it; refuse and count it when it is not finite."""
    field: Vector = sample.magnetic_field or (0.0, 0.0, 0.0)
    if not is_finite(sample.specific_force, sample.angular_rate, field):
        counters[Refusal.NOT_FINITE] += 1
        return False
    samples.append(sample)
    counters["samples"] += 1
    return True
