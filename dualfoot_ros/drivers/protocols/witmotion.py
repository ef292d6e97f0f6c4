"""WitMotion output: frames of 11 bytes, ``0x55``, a type, eight bytes, their sum.

After the maker's protocol pages (docs.wit-motion.com).  An acceleration frame and the angular
rate frame behind it are one sample.  The header byte occurs in payloads and the sum is 8 bits,
so the framer asks a frame that does not follow another for a second one behind it.

Bluetooth models send frames of 20 bytes instead, ``0x55 0x61`` with acceleration, angular rate and
angles as nine words, and without a sum: what follows such a frame has to begin with the header.
"""

from __future__ import annotations

import datetime
import struct
from collections import Counter
from dataclasses import dataclass

from ...core import DEGREE, STANDARD_GRAVITY, Increments, Parameters, Refusal, Vector, parameter
from ..sample import Sample, scaled
from .decoder import append_if_finite
from .framing import BAD_CHECKSUM, NEED_MORE, NO_FRAME, HeaderFramer

HEADER = 0x55
LENGTH = 11
TIME, ACCELERATION, RATE, FIELD = 0x50, 0x51, 0x52, 0x54
COMBINED, REGISTERS = 0x61, 0x71
LONG_LENGTH = 20  # of the last two
FIRST_TYPE, LAST_TYPE = 0x50, 0x5F
WORDS = struct.Struct("<4h")
NINE_WORDS = struct.Struct("<9h")
DATE = struct.Struct("<6BH")
FULL_SCALE = 32768.0
TICK_NS = 1_000_000
EPOCH = datetime.datetime(2000, 1, 1)


@dataclass(frozen=True)
class WitMotionConfig(Parameters):
    """Options of the WitMotion decoder: the ranges the device is set to."""

    force_range: float = parameter(
        16.0, "range of the accelerometer", unit="g", minimum=1.0, maximum=400.0
    )
    rate_range: float = parameter(
        2000.0, "range of the gyroscope", unit="deg/s", minimum=100.0, maximum=10000.0
    )
    field_unit: float = parameter(
        0.0,
        "T for 1 in the device's unit, which differs by model; 0 leaves the field out",
        unit="T",
        minimum=0.0,
        maximum=1e-3,
    )


class WitMotionDecoder:
    """Decoder that pairs acceleration and angular rate frames."""

    message_oriented = False

    def __init__(self, config: WitMotionConfig | None = None) -> None:
        """Start with an empty buffer."""
        config = config or WitMotionConfig()
        self.counters: Counter[str] = Counter()
        self._framer = HeaderFramer(HEADER, probe, LONG_LENGTH, self.counters, after_a_gap)
        self.max_buffer = self._framer.max_buffer
        self._force_scale = config.force_range * STANDARD_GRAVITY / FULL_SCALE
        self._rate_scale = config.rate_range * DEGREE / FULL_SCALE
        self._field_unit = config.field_unit
        self.reset()

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received frame or sample."""
        self._framer.reset()
        self._force: Vector | None = None
        self._ticks: int | None = None
        self._temperature: float | None = None
        self._field: Vector | None = None

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for frame in self._framer.push(data):
            if frame and frame[1] == COMBINED:
                self._take_combined(frame[2:], arrival_ns, samples)
            elif frame:
                self._take(frame[1], frame[2:10], arrival_ns, samples)
            else:  # what follows a gap may belong to another sample
                self._drop_half()
        return samples

    def _take(self, kind: int, content: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        if kind == RATE:
            self._complete(WORDS.unpack(content)[:3], arrival_ns, samples)
        elif kind == ACCELERATION:
            *words, centidegrees = WORDS.unpack(content)
            self.counters[Refusal.INCOMPLETE] += self._force is not None
            self._force = scaled(tuple(words), self._force_scale)
            self._temperature = centidegrees / 100.0
        elif kind == TIME:
            self._drop_half()
            self._ticks = _read_milliseconds(content)
            self.counters[Refusal.MALFORMED] += self._ticks is None
        elif kind == FIELD and self._field_unit:
            self._field = scaled(WORDS.unpack(content)[:3], self._field_unit)
        else:
            self.counters[Refusal.OTHER] += 1

    def _take_combined(self, content: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        """Make a sample of a frame that has both halves, and the angles behind them."""
        self._drop_half()
        words = NINE_WORDS.unpack(content)
        self._force = scaled(words[:3], self._force_scale)
        self._complete(words[3:6], arrival_ns, samples)

    def _drop_half(self) -> None:
        self.counters[Refusal.INCOMPLETE] += self._force is not None
        self._force = self._ticks = None

    def _complete(self, words: tuple[int, ...], arrival_ns: int, samples: list[Sample]) -> None:
        """Make a sample of the acceleration frame before and this angular rate frame."""
        if self._force is None:
            self.counters[Refusal.INCOMPLETE] += 1
            return
        rate = scaled(words, self._rate_scale)
        sample = Sample(
            arrival_ns,
            self._force,
            rate,
            self._ticks,
            TICK_NS,
            64,
            self._temperature,
            self._field,
            increments=Increments.SAMPLED,
        )
        self._force = self._ticks = None
        append_if_finite(self.counters, samples, sample)


def probe(buffer: bytearray, at: int) -> int:
    """Look at a frame that may start at ``at``, as :data:`framing.Probe` says."""
    head = buffer[at : at + 2]
    if head[:1] not in (b"", bytes([HEADER])):
        return NO_FRAME
    if len(head) == 2 and head[1] in (COMBINED, REGISTERS):
        return _probe_long(buffer, at)
    if len(head) == 2 and not FIRST_TYPE <= head[1] <= LAST_TYPE:
        return NO_FRAME
    if at + LENGTH > len(buffer):
        return NEED_MORE
    valid = sum(buffer[at : at + LENGTH - 1]) & 0xFF == buffer[at + LENGTH - 1]
    return LENGTH if valid else BAD_CHECKSUM


def _probe_long(buffer: bytearray, at: int) -> int:
    """Look at a frame without a sum: only the header of the next one can tell."""
    end = at + LONG_LENGTH
    if end > len(buffer):
        return NEED_MORE
    return NO_FRAME if buffer[end : end + 1] not in (b"", bytes([HEADER])) else LONG_LENGTH


def after_a_gap(_frame: bytes, in_step: bool) -> bool:
    """Doubt what follows no frame: a sum of eight bits is right by chance too often."""
    return not in_step


def _read_milliseconds(content: bytes) -> int | None:
    """Return the device's date and time as milliseconds since 2000, or None for no date."""
    year, month, day, hour, minute, second, millisecond = DATE.unpack(content)
    try:
        stamp = datetime.datetime(2000 + year, month, day, hour, minute, second)
    except ValueError:
        return None
    milliseconds: int = int((stamp - EPOCH).total_seconds()) * 1000 + millisecond
    return milliseconds
