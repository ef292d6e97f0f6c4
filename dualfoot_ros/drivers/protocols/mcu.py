"""Frame for boards of one's own, described in ``docs/reference/mcu_frame.md``; encoder in C there.

COBS, terminated by a zero.  Inside, little-endian: kind u8, counter u16, device time u32 in
microseconds, six values, what the flags announce, CRC-16/CCITT-FALSE over all before it.
"""

from __future__ import annotations

import struct
from binascii import crc_hqx
from collections import Counter
from dataclasses import dataclass

from ...core import Increments, Parameters, Refusal, Vector
from ..sample import Sample, scaled
from . import cobs
from .decoder import PacketCounter, append_if_finite
from .framing import DelimitedFramer

HEADER = struct.Struct("<BHI")
FLOATS = struct.Struct("<6f")
SCALED = struct.Struct("<2f6h")
TEMPERATURE = struct.Struct("<h")
FIELD = struct.Struct("<3h")
CRC = struct.Struct("<H")

LAYOUTS = {1: FLOATS, 2: SCALED}
LAYOUT_BITS = 0x0F
WITH_TEMPERATURE = 0x10
WITH_FIELD = 0x20
KINDS = (None, Increments.AVERAGED, Increments.SAMPLED, Increments.COMPENSATED)
KIND_SHIFT = 6  # to the two bits that number them

CENTIDEGREE = 0.01  # degrees Celsius
TENTH_MICROTESLA = 1e-7  # T
MAX_FRAME = 64  # the longest is 42 bytes with its COBS code


@dataclass(frozen=True)
class McuConfig(Parameters):
    """No options: the frame describes itself."""


class McuDecoder:
    """Decoder of the frame for boards of one's own."""

    message_oriented = False
    max_buffer = MAX_FRAME

    def __init__(self, config: McuConfig | None = None) -> None:
        """Start with an empty buffer."""
        self.counters: Counter[str] = Counter()
        self._framer = DelimitedFramer(0, MAX_FRAME, self.counters)
        self._packets = PacketCounter(self.counters, 16)

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received frame."""
        self._framer.reset()
        self._packets.reset()

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for frame in self._framer.push(data):
            content = self._check(frame)
            if content is not None:
                self._decode(content, arrival_ns, samples)
        return samples

    def _check(self, frame: bytes) -> bytes | None:
        """Return the content of a frame whose checksum is right, else None."""
        plain = cobs.decode(frame)
        if plain is None or len(plain) <= HEADER.size + CRC.size:
            self.counters[Refusal.MALFORMED] += 1
            return None
        content = plain[: -CRC.size]
        if crc_hqx(content, 0xFFFF) != CRC.unpack(plain[-CRC.size :])[0]:
            self.counters[Refusal.BAD_CHECKSUM] += 1
            return None
        return content

    def _decode(self, content: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        kind, counter, device_us = HEADER.unpack_from(content)
        layout = LAYOUTS.get(kind & LAYOUT_BITS)
        if layout is None:
            self.counters[Refusal.OTHER] += 1
            return
        if len(content) != HEADER.size + layout.size + _extra_size(kind):
            self.counters[Refusal.MALFORMED] += 1
            return
        force, rate = _read_motion(layout, layout.unpack_from(content, HEADER.size))
        temperature, field = _read_extras(kind, content, HEADER.size + layout.size)
        self._packets.count(counter)
        extras = temperature, field, counter, KINDS[kind >> KIND_SHIFT]
        sample = Sample(arrival_ns, force, rate, device_us, 1000, 32, *extras)
        append_if_finite(self.counters, samples, sample)


def _read_motion(layout: struct.Struct, values: tuple[float, ...]) -> tuple[Vector, Vector]:
    """Return specific force and angular rate; whole numbers carry their scales before them."""
    if layout is FLOATS:
        return values[0:3], values[3:6]  # type: ignore[return-value]
    return scaled(values[2:5], values[0]), scaled(values[5:8], values[1])


def _extra_size(kind: int) -> int:
    size = TEMPERATURE.size if kind & WITH_TEMPERATURE else 0
    return size + (FIELD.size if kind & WITH_FIELD else 0)


def _read_extras(kind: int, content: bytes, at: int) -> tuple[float | None, Vector | None]:
    """Return temperature and magnetic field where the flags announce them."""
    temperature = field = None
    if kind & WITH_TEMPERATURE:
        temperature = TEMPERATURE.unpack_from(content, at)[0] * CENTIDEGREE
        at += TEMPERATURE.size
    if kind & WITH_FIELD:
        field = scaled(FIELD.unpack_from(content, at), TENTH_MICROTESLA)
    return temperature, field
