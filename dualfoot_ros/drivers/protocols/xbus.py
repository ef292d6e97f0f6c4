"""Xsens MTi: MTData2 and MTData messages of the Xbus protocol.

After the maker's MT Low Level Communication Protocol.  A message is preamble ``0xFA``, bus
identifier, message identifier, length, data, and a byte that makes the sum of all but the
preamble zero.  The data of MTData2 is a row of items: identifier u16, length u8, values, all
big-endian; the last bits of the identifier say how numbers are written.

DeltaQ and DeltaV are the increments of the device, compensated for coning and sculling; RateOfTurn
and Acceleration come from the same by inverse strapdown integration, so Acceleration is DeltaV per
second (MTi reference manual 4.3, DOT user manual 4.2).  The increments have the full resolution.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from ...core import Refusal, Vector, parameter
from ..sample import Sample, scaled
from .decoder import FieldConfig, PacketCounter, append_if_finite
from .delta import OutputInterval
from .framing import BAD_CHECKSUM, NEED_MORE, NO_FRAME, HeaderFramer
from .xbus_apart import ApartHalves, Turn
from .xbus_items import (
    DELTA_Q,
    KIND,
    MAGNETIC_FIELD,
    MOTION,
    PACKET_COUNTER,
    PRECISION,
    SAMPLE_TIME_FINE,
    SIZES,
    TEMPERATURE,
    Items,
    items_of,
    read_force,
    read_increments,
    read_motion,
    read_rate,
    read_reals,
    read_whole,
)
from .xbus_legacy import read_mtdata

PREAMBLE = 0xFA
ALONE = (0xFF, 0x01)  # identifiers of a device on its own, and of the first one on a bus
LAST_ON_BUS = 0x20
MTDATA2, MTDATA = 0x36, 0x32
EXTENDED = 0xFF
MAX_FRAME = 1024

TICK_NS = 100_000  # SampleTimeFine counts at 10 kHz


@dataclass(frozen=True)
class XbusConfig(FieldConfig):
    """Options of the Xbus decoder."""

    bus_id: int = parameter(
        0,
        "device on a bus of several whose messages are used; 0 takes one on its own, or the first",
        minimum=0,
        maximum=LAST_ON_BUS,
    )
    mtdata_temperature: bool = parameter(
        False, "messages MTData begin with a temperature (older devices)"
    )


class XbusDecoder:
    """Decoder of messages that hold acceleration and rate of turn, together or apart.

    ``devices`` counts the messages with data of each bus identifier.
    """

    message_oriented = False

    def __init__(self, config: XbusConfig | None = None) -> None:
        """Start with an empty buffer."""
        self.counters: Counter[str] = Counter()
        self._framer = HeaderFramer(PREAMBLE, probe, MAX_FRAME, self.counters, no_motion)
        self.max_buffer = self._framer.max_buffer
        self._packets = PacketCounter(self.counters, 16)
        self._interval = OutputInterval(TICK_NS, 32)
        self._apart = ApartHalves(self.counters)
        config = config or XbusConfig()
        self._field_unit = config.field_unit
        self._with_temperature = config.mtdata_temperature
        self._ids = (config.bus_id,) if config.bus_id else ALONE
        self.devices: Counter[int] = Counter()
        self._temperature: float | None = None

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received message."""
        self._framer.reset()
        self._packets.reset()
        self._interval.reset()
        self._apart.reset()
        self._temperature = None

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for frame in filter(None, self._framer.push(data)):
            self.devices[frame[1]] += frame[2] in (MTDATA2, MTDATA)
            if frame[1] not in self._ids:
                self.counters[Refusal.OTHER] += 1
            elif frame[2] == MTDATA:
                self._decode_legacy(_cut_content(frame), arrival_ns, samples)
            elif frame[2] == MTDATA2:
                self._decode(_cut_content(frame), arrival_ns, samples)
            else:
                self.counters[Refusal.OTHER] += 1
        return samples

    def _decode(self, content: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        items = {key & KIND: (key & PRECISION, value) for key, value in items_of(content)}
        counter = read_whole(items, PACKET_COUNTER, 2)
        if counter is not None:
            self._packets.count(counter)
        self._temperature = _take_first(read_reals(items, TEMPERATURE, 1), self._temperature)
        ticks, field = read_whole(items, SAMPLE_TIME_FINE, 4), self._field(items)
        if ticks is not None and DELTA_Q in items:  # messages apart come between
            self._interval.add(ticks)
        motion = read_increments(items, self._interval.seconds) or read_motion(items)
        if motion is None:
            self._join_half(items, ticks, counter, arrival_ns, samples)
            return
        force, rate, kind = motion
        turn = Turn(ticks, counter, scaled(rate, 1.0), field, kind)
        self._append(turn, scaled(force, 1.0), arrival_ns, samples)

    def _join_half(
        self,
        items: Items,
        ticks: int | None,
        counter: int | None,
        arrival_ns: int,
        samples: list[Sample],
    ) -> None:
        """Take a message with one half of a sample."""
        force, (rate, kind) = read_force(items), read_rate(items)
        if ticks is None or (rate is None and force is None):
            self.counters[Refusal.INCOMPLETE] += 1
        elif rate is not None:
            turn = Turn(ticks, counter, scaled(rate, 1.0), self._field(items), kind)
            self._apart.add_rate(turn)
        elif force is not None:
            for turn, between in self._apart.add_force(ticks, scaled(force, 1.0)):
                self._append(turn, between, arrival_ns, samples)

    def _decode_legacy(self, content: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        found = read_mtdata(content, self._with_temperature)
        if found is None:
            self.counters[Refusal.INCOMPLETE] += 1
            return
        if found.counter is not None:
            self._packets.count(found.counter)
        self._temperature = found.temperature
        field = scaled(found.field, self._field_unit) if self._field_unit else None
        turn = Turn(None, found.counter, found.rate, field)
        self._append(turn, found.force, arrival_ns, samples)

    def _append(self, turn: Turn, force: Vector, arrival_ns: int, samples: list[Sample]) -> None:
        sample = Sample(
            arrival_ns,
            force,
            turn.rate,
            turn.ticks,
            TICK_NS,
            32,
            self._temperature,
            turn.field,
            turn.counter,
            turn.kind,
        )
        append_if_finite(self.counters, samples, sample)

    def _field(self, items: Items) -> Vector | None:
        field = read_reals(items, MAGNETIC_FIELD, 3) if self._field_unit else None
        return None if field is None else scaled(field, self._field_unit)


def probe(buffer: bytearray, at: int) -> int:
    """Look at a message that may start at ``at``, as :data:`framing.Probe` says."""
    head = bytes(buffer[at : at + 6])
    if head[:1] not in (b"", b"\xfa") or (len(head) > 1 and not _is_bus_id(head[1])):
        return NO_FRAME
    if len(head) < 4 or (head[3] == EXTENDED and len(head) < 6):
        return NEED_MORE
    length = int.from_bytes(head[4:6], "big") + 7 if head[3] == EXTENDED else head[3] + 5
    if length > MAX_FRAME:
        return NO_FRAME
    if at + length > len(buffer):
        return NEED_MORE
    frame = buffer[at : at + length]
    if sum(frame[1:]) & 0xFF:
        return BAD_CHECKSUM
    if frame[2] == MTDATA2 and not _is_row_of_items(_cut_content(frame)):
        return NO_FRAME
    return length


def _is_bus_id(identifier: int) -> bool:
    return identifier == ALONE[0] or 1 <= identifier <= LAST_ON_BUS


def no_motion(frame: bytes, in_step: bool) -> bool:
    """Doubt all but items of motion, which are no chance, and MTData in step."""
    if frame[2] == MTDATA:
        return not in_step
    if frame[2] != MTDATA2:
        return True
    return not any(
        len(value) == MOTION.get(key & KIND, 0) * SIZES[key & PRECISION] > 0
        for key, value in items_of(_cut_content(frame))
    )


def _is_row_of_items(content: bytes) -> bool:
    return sum(3 + len(value) for _, value in items_of(content)) == len(content)


def _cut_content(frame: bytes | bytearray) -> bytes:
    return bytes(frame[6:-1] if frame[3] == EXTENDED else frame[4:-1])


def _take_first(values: tuple[float, ...] | None, otherwise: float | None) -> float | None:
    return otherwise if values is None else values[0]
