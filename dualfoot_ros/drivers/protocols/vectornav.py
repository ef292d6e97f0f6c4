"""VectorNav VN-100/200/300 binary output.

After the VN-100 User Manual (UM001), chapter "Serial output message format": sync ``0xFA``, one
bit for each group of fields, u16 masks of the fields in every group, the fields back to back,
CRC-16 (polynomial 0x1021, start 0) sent high byte first.  All else is little-endian.

Increments (DeltaTheta, DeltaVel) are better than rates and used where they are sent; register 82
must leave them in the body frame, its default.  The manual does not name the axes of DeltaVel;
they are taken to be those at the start of the interval, as a fully coupled integral has them.
"""

from __future__ import annotations

import struct
from binascii import crc_hqx
from collections import Counter
from dataclasses import dataclass
from functools import lru_cache

from ...core import DEGREE, Increments, Parameters, Refusal, Vector, parameter
from ..sample import Sample, scaled
from .decoder import append_if_finite
from .delta import held_push, per_second
from .framing import BAD_CHECKSUM, NEED_MORE, NO_FRAME, HeaderFramer

SYNC = 0xFA
MAX_FRAME = 600
LONGEST_S = 1.0  # an interval beyond is none
GAUSS = 1e-4  # T
VECTOR = struct.Struct("<3f")
NUMBER = struct.Struct("<f")
STARTUP = struct.Struct("<Q")

SIZES = (
    (8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8),
    (8, 8, 8, 2, 8, 8, 8, 4, 4, 1, 1),
    (2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2, 40),
    (8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28),
    (2, 12, 16, 36, 12, 12, 12, 12, 12, 12, 28, 24, 12),
    (2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4, 68, 64),
    (8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28),
)
"""Bytes of each field of the groups common, time, IMU, GNSS, attitude, INS and second GNSS.

Fields beyond have no fixed size; a message that holds one cannot be measured and is skipped.
"""

Field = tuple[int, int]  # group and bit, from zero
Motion = tuple[Vector, Vector]  # specific force, angular rate
TIME: tuple[Field, ...] = ((0, 0), (1, 0))
IMU: Field = (0, 9)  # uncompensated acceleration, then angular rate
MAGNETIC_PRESSURE: Field = (0, 10)  # magnetic field, temperature, pressure
UNCOMPENSATED: tuple[tuple[Field, ...], tuple[Field, ...]] = (((2, 2),), ((2, 3),))
COMPENSATED: tuple[tuple[Field, ...], tuple[Field, ...]] = (((0, 8), (2, 9)), ((0, 5), (2, 10)))
DELTA: Field = (0, 11)  # interval, rotation, change of velocity
DELTA_THETA: Field = (2, 6)  # interval, rotation
DELTA_VELOCITY: Field = (2, 7)
TEMPERATURE: Field = (2, 4)
MOTION_GROUPS = (0, 2)  # common and IMU
MAGNETIC: tuple[Field, ...] = ((2, 1), (2, 8))


@dataclass(frozen=True)
class VectorNavConfig(Parameters):
    """Options of the VectorNav decoder."""

    prefer: str = parameter(
        "uncompensated",
        "which is used when both are sent; the compensated values have the device's own, "
        "wandering bias estimates taken off",
        choices=("uncompensated", "compensated"),
    )


class VectorNavDecoder:
    """Decoder of binary messages that hold acceleration and angular rate."""

    message_oriented = False

    def __init__(self, config: VectorNavConfig | None = None) -> None:
        """Start with an empty buffer."""
        self.counters: Counter[str] = Counter()
        self._framer = HeaderFramer(SYNC, probe, MAX_FRAME, self.counters, never)
        self.max_buffer = self._framer.max_buffer
        self._uncompensated = (config or VectorNavConfig()).prefer == "uncompensated"
        self._temperature: float | None = None

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received message."""
        self._framer.reset()
        self._temperature = None

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for frame in filter(None, self._framer.push(data)):
            self._decode(frame, arrival_ns, samples)
        return samples

    def _decode(self, frame: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        offsets = _offsets(frame)
        motion = self._motion(frame, offsets)
        if motion is None:
            of_motion = any(group in MOTION_GROUPS for group, _ in offsets)
            self.counters[Refusal.INCOMPLETE if of_motion else Refusal.OTHER] += 1
            return
        self._temperature = _read_temperature(frame, offsets, self._temperature)
        time = next(
            (STARTUP.unpack_from(frame, offsets[f])[0] for f in TIME if f in offsets), None
        )
        field = _read_field(frame, offsets)
        force, rate, kind = motion
        sample = Sample(arrival_ns, force, rate, time, 1, 64, self._temperature, field, None, kind)
        append_if_finite(self.counters, samples, sample)

    def _motion(
        self, frame: bytes, offsets: dict[Field, int]
    ) -> tuple[Vector, Vector, Increments] | None:
        """Return force, rate and their kind: increments, else the preferred rates, else others."""
        increments = _read_increments(frame, offsets)
        if increments is not None:
            return *increments, Increments.COMPENSATED
        raw, own = _read_raw(frame, offsets), _read_vectors(frame, offsets, COMPENSATED)
        rates = (raw or own) if self._uncompensated else (own or raw)
        return None if rates is None else (*rates, Increments.SAMPLED)


def probe(buffer: bytearray, at: int) -> int:
    """Look at a message that may start at ``at``, as :data:`framing.Probe` says."""
    if at >= len(buffer):
        return NEED_MORE
    if buffer[at] != SYNC:
        return NO_FRAME
    if at + 1 >= len(buffer):
        return NEED_MORE
    header = 2 + 2 * buffer[at + 1].bit_count()
    if at + header > len(buffer):
        return NEED_MORE
    fields = layout(bytes(buffer[at + 1 : at + header]))
    if fields is None:
        return NO_FRAME
    length = header + sum(size for _, size in fields) + 2
    if length > MAX_FRAME:
        return NO_FRAME
    if at + length > len(buffer):
        return NEED_MORE
    return length if crc_hqx(buffer[at + 1 : at + length], 0) == 0 else BAD_CHECKSUM


def never(_frame: bytes, _in_step: bool) -> bool:
    """Doubt no message: layout and 16 bits of checksum are never right by chance."""
    return False


@lru_cache(maxsize=64)
def layout(header: bytes) -> tuple[tuple[Field, int], ...] | None:
    """Return fields and sizes that a header (group byte and masks) announces, or None.

    None stands for a header with no field, an extension or a field of unknown size.
    """
    groups = [group for group in range(8) if header[0] >> group & 1]
    fields: list[tuple[Field, int]] = []
    for place, group in enumerate(groups):
        mask = int.from_bytes(header[1 + 2 * place : 3 + 2 * place], "little")
        if group >= len(SIZES) or mask >> len(SIZES[group]):
            return None
        sizes = enumerate(SIZES[group])
        fields += [((group, bit), size) for bit, size in sizes if mask >> bit & 1]
    return tuple(fields) if fields else None


def _offsets(frame: bytes) -> dict[Field, int]:
    """Return where in the message each field starts."""
    at = 2 + 2 * frame[1].bit_count()
    offsets: dict[Field, int] = {}
    for field, size in layout(frame[1:at]) or ():
        offsets[field] = at
        at += size
    return offsets


def _read_increments(frame: bytes, offsets: dict[Field, int]) -> Motion | None:
    """Return the force and rate that, held, give the device's increments; None without them."""
    theta_at, push_at = offsets.get(DELTA_THETA), offsets.get(DELTA_VELOCITY)
    if DELTA in offsets:
        theta_at, push_at = offsets[DELTA], offsets[DELTA] + NUMBER.size + VECTOR.size
    if theta_at is None or push_at is None:
        return None
    (interval_s,) = NUMBER.unpack_from(frame, theta_at)
    if not 0.0 < interval_s < LONGEST_S:
        return None
    rotation = scaled(VECTOR.unpack_from(frame, theta_at + NUMBER.size), DEGREE)
    push = held_push(rotation, VECTOR.unpack_from(frame, push_at))
    return per_second(push, interval_s), per_second(rotation, interval_s)


def _read_raw(frame: bytes, offsets: dict[Field, int]) -> Motion | None:
    if IMU in offsets:
        at = offsets[IMU]
        return VECTOR.unpack_from(frame, at), VECTOR.unpack_from(frame, at + VECTOR.size)
    return _read_vectors(frame, offsets, UNCOMPENSATED)


def _read_vectors(
    frame: bytes,
    offsets: dict[Field, int],
    wanted: tuple[tuple[Field, ...], tuple[Field, ...]],
) -> tuple[Vector, Vector] | None:
    force, rate = (next((offsets[f] for f in fields if f in offsets), None) for fields in wanted)
    if force is None or rate is None:
        return None
    return VECTOR.unpack_from(frame, force), VECTOR.unpack_from(frame, rate)


def _read_temperature(
    frame: bytes, offsets: dict[Field, int], otherwise: float | None
) -> float | None:
    if TEMPERATURE in offsets:
        return float(NUMBER.unpack_from(frame, offsets[TEMPERATURE])[0])
    if MAGNETIC_PRESSURE in offsets:
        at = offsets[MAGNETIC_PRESSURE] + VECTOR.size
        return float(NUMBER.unpack_from(frame, at)[0])
    return otherwise


def _read_field(frame: bytes, offsets: dict[Field, int]) -> Vector | None:
    at = next((offsets[f] for f in (*MAGNETIC, MAGNETIC_PRESSURE) if f in offsets), None)
    return None if at is None else scaled(VECTOR.unpack_from(frame, at), GAUSS)
