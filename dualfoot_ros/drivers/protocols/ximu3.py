"""x-io x-IMU3: ASCII and binary data messages, the same on USB, serial, UDP and TCP.

After the maker's x-IMU3 User Manual, chapter "Communication protocol".  Every message ends with
a line feed.  ASCII: a letter, microseconds, values.  Binary: the letter + 0x80, microseconds as
u64, f32 values, all little-endian, stuffed so that no 0x0A occurs before the end.  There is no
checksum, so only the length and the values themselves can tell damage.
"""

from __future__ import annotations

import math
import struct
from collections import Counter
from dataclasses import dataclass

from ...core import DEGREE, STANDARD_GRAVITY, Increments, Refusal, Vector
from ..sample import Sample, scaled
from .decoder import FieldConfig, append_if_finite
from .delta import OutputInterval
from .framing import DelimitedFramer

END, ESCAPE, ESCAPED_END, ESCAPED_ESCAPE = b"\n", b"\xdb", b"\xdb\xdc", b"\xdb\xdd"
STAMP = struct.Struct("<Q")
VALUES = {"I": 6, "M": 3, "T": 1}
"""Inertial, magnetometer and temperature messages, with their number of values."""
BINARY = 0x80
MAX_MESSAGE = 512
SAMPLING_S = 1.0 / 400.0  # of the device; slower messages hold means (manual, 9.2, 9.3)
SEEN = 8  # intervals, of which one at least was not lengthened by a loss


@dataclass(frozen=True)
class XImu3Config(FieldConfig):
    """Options of the x-IMU3 decoder."""


class XImu3Decoder:
    """Decoder of x-IMU3 messages, ASCII and binary in any mixture."""

    message_oriented = False
    max_buffer = MAX_MESSAGE

    def __init__(self, config: XImu3Config | None = None) -> None:
        """Start with an empty buffer."""
        self.counters: Counter[str] = Counter()
        self._framer = DelimitedFramer(END[0], MAX_MESSAGE, self.counters)
        self._field_unit = (config or XImu3Config()).field_unit
        self._interval = OutputInterval(1000, 64)
        self._temperature: float | None = None
        self._field: Vector | None = None

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received message, the interval, temperature and field."""
        self._framer.reset()
        self._interval.reset()
        self._temperature = self._field = None

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for message in self._framer.push(data):
            letter = chr(message[0] & 0x7F)
            if letter not in VALUES:
                self.counters[Refusal.OTHER] += 1
                continue
            parsed = _parse_binary(message) if message[0] & BINARY else _parse_ascii(message)
            if parsed is None or len(parsed[1]) != VALUES[letter]:
                self.counters[Refusal.MALFORMED] += 1
                continue
            self._take(letter, *parsed, arrival_ns, samples)
        return samples

    def _take(
        self,
        letter: str,
        ticks: int,
        values: tuple[float, ...],
        arrival_ns: int,
        samples: list[Sample],
    ) -> None:
        if not all(map(math.isfinite, values)):
            self.counters[Refusal.NOT_FINITE] += 1
        elif letter == "T":
            self._temperature = values[0]
        elif letter == "M":
            self._field = scaled(values, self._field_unit) if self._field_unit else None
        else:
            force, rate = scaled(values[3:], STANDARD_GRAVITY), scaled(values[:3], DEGREE)
            self._interval.add(ticks)
            extras = self._temperature, self._field, None, self._find_kind()
            append_if_finite(
                self.counters, samples, Sample(arrival_ns, force, rate, ticks, 1000, 64, *extras)
            )

    def _find_kind(self) -> Increments | None:
        """Return what the messages are: the device averages those that it does not send all."""
        interval_s = self._interval.seconds
        if interval_s is None or self._interval.count < SEEN:
            return None
        return Increments.SAMPLED if interval_s < 1.5 * SAMPLING_S else Increments.AVERAGED


def _parse_binary(message: bytes) -> tuple[int, tuple[float, ...]] | None:
    plain = _unstuff(message)
    if plain is None or len(plain) < 1 + STAMP.size or (len(plain) - 1 - STAMP.size) % 4:
        return None
    count = (len(plain) - 1 - STAMP.size) // 4
    (ticks,) = STAMP.unpack_from(plain, 1)
    return ticks, struct.unpack_from(f"<{count}f", plain, 1 + STAMP.size)


def _unstuff(message: bytes) -> bytes | None:
    """Undo the byte stuffing, or return None where an escape is followed by anything else."""
    first, *parts = message.split(ESCAPE)
    plain = [first]
    for part in parts:
        if part[:1] not in (ESCAPED_END[1:], ESCAPED_ESCAPE[1:]):
            return None
        plain += [END if part[:1] == ESCAPED_END[1:] else ESCAPE, part[1:]]
    return b"".join(plain)


def _parse_ascii(message: bytes) -> tuple[int, tuple[float, ...]] | None:
    fields = message.split(b",")
    if b"_" in message or len(fields) < 3 or len(fields[0]) != 1:
        return None
    try:
        ticks = int(fields[1])
        values = tuple(float(field) for field in fields[2:])
    except ValueError:
        return None
    return (ticks, values) if 0 <= ticks < 1 << 64 else None
