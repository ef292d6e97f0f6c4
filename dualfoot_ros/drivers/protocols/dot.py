"""Xsens (Movella) DOT, live: the measurement payloads of its BLE service.

After the Movella DOT BLE Service Specification (XD0506P), section 3: one notification is one
sample, little-endian, microseconds u32 first; acceleration m/s^2, angular velocity deg/s, both
from increments that the device has compensated at 800 Hz (DOT user manual, 4.2).  The device pads
notifications with zeros, so the length does not tell the mode.
"""

from __future__ import annotations

import struct
from collections import Counter
from dataclasses import dataclass

from ...core import DEGREE, Increments, Refusal, Vector, parameter
from ..sample import Sample, scaled
from .decoder import FieldConfig, append_if_finite

STAMP = struct.Struct("<I")
MOTION = struct.Struct("<6f")
FIELD = struct.Struct("<3h")
FIELD_STEPS = 4096.0  # the field comes as fixed point with 12 bits of fraction
MAX_MESSAGE = 63


@dataclass(frozen=True)
class Payload:
    """A payload mode: the number that selects it, where values stand, its length in bytes."""

    mode: int
    motion_at: int
    field_at: int | None
    length: int
    characteristic: int


PAYLOADS = {
    "rate": Payload(21, 4, None, 28, 0x2003),
    "rate_mag": Payload(20, 4, 28, 34, 0x2003),
    "custom5": Payload(26, 20, None, 44, 0x2002),
}


@dataclass(frozen=True)
class DotConfig(FieldConfig):
    """Options of the DOT decoder; the BLE transport asks the device for the same payload."""

    payload: str = parameter(
        "rate", "measurement mode that the device is set to", choices=tuple(PAYLOADS)
    )


class DotDecoder:
    """Decoder of notifications, one a call."""

    message_oriented = True
    max_buffer = 0
    buffered = 0

    def __init__(self, config: DotConfig | None = None) -> None:
        """Expect the payload that ``config`` names."""
        config = config or DotConfig()
        self.counters: Counter[str] = Counter()
        self._payload = PAYLOADS[config.payload]
        self._field_unit = config.field_unit

    def reset(self) -> None:
        """Do nothing: there are no half messages."""

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the sample of one notification."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        if not self._payload.length <= len(data) <= MAX_MESSAGE:
            self.counters[Refusal.MALFORMED] += 1
            self.counters[Refusal.GARBAGE_BYTES] += len(data)
            return samples
        (ticks,) = STAMP.unpack_from(data)
        values = MOTION.unpack_from(data, self._payload.motion_at)
        force, rate = scaled(values[:3], 1.0), scaled(values[3:], DEGREE)
        sample = Sample(
            arrival_ns,
            force,
            rate,
            ticks,
            1000,
            32,
            magnetic_field=self._read_field(data),
            increments=Increments.COMPENSATED,
        )
        append_if_finite(self.counters, samples, sample)
        return samples

    def _read_field(self, data: bytes) -> Vector | None:
        if self._payload.field_at is None or not self._field_unit:
            return None
        steps = FIELD.unpack_from(data, self._payload.field_at)
        return scaled(steps, self._field_unit / FIELD_STEPS)
