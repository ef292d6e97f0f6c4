"""What every decoder promises, and the few lines they share.

A decoder takes bytes as they come and gives samples.  It never raises for data, counts all it
refuses, keeps at most ``max_buffer`` bytes between calls, and is back in step at the latest with
the second valid frame after any garbage.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Protocol

from ...core import Parameters, parameter
from ..sample import Sample, Vector, is_finite

COUNTERS = {
    "bytes": "bytes handed to the decoder",
    "samples": "samples delivered",
    "garbage_bytes": "bytes that belong to no frame",
    "bad_checksum": "frames refused because their checksum is wrong",
    "malformed": "frames refused because their content does not fit the format",
    "not_finite": "samples refused because a value is not a number or infinite",
    "incomplete": "frames without both specific force and angular rate",
    "other": "valid frames of kinds that are not used here",
    "lost": "samples missing by the device's packet counter",
    "repeated": "samples whose packet counter did not advance",
}
"""What a decoder counts; a name that is absent from ``counters`` has never happened."""


class Decoder(Protocol):
    """Bytes in, samples out; never raises for data."""

    counters: Counter[str]
    max_buffer: int
    message_oriented: bool
    """True when every call of ``feed`` must bring exactly one message of the transport."""

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Take the next bytes, read at ``arrival_ns`` (host wall clock), and return samples."""
        ...

    def reset(self) -> None:
        """Forget a half-received frame, because the link was lost; counters stay."""
        ...

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        ...


@dataclass(frozen=True)
class FieldOptions(Parameters):
    """Options of a decoder whose device sends the magnetic field in a unit of its own."""

    field_unit: float = parameter(
        0.0,
        "T for 1 in the device's arbitrary unit; 0 leaves the magnetic field out",
        unit="T",
        minimum=0.0,
        maximum=1e-3,
    )


class PacketCounter:
    """Count lost and repeated packets from a counter of ``bits`` bits that wraps."""

    def __init__(self, counters: Counter[str], bits: int) -> None:
        """Report into ``counters``."""
        self._counters = counters
        self._modulus = 1 << bits
        self._last: int | None = None

    def see(self, counter: int) -> None:
        """Take the counter of the next packet; a step of more than half the range is a restart."""
        if self._last is not None:
            step = (counter - self._last) % self._modulus
            if step == 0:
                self._counters["repeated"] += 1
            elif step <= self._modulus // 2:
                self._counters["lost"] += step - 1
        self._last = counter

    def reset(self) -> None:
        """Forget the last counter, so that a new connection is no loss."""
        self._last = None


def deliver(counters: Counter[str], samples: list[Sample], sample: Sample) -> bool:
    """Append ``sample`` and count it, or refuse and count it when it is not finite."""
    field: Vector = sample.magnetic_field or (0.0, 0.0, 0.0)
    if not is_finite(sample.specific_force, sample.angular_rate, field):
        counters["not_finite"] += 1
        return False
    samples.append(sample)
    counters["samples"] += 1
    return True
