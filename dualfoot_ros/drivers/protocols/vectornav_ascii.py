"""VectorNav VN-100/200/300 ASCII output: the lines with acceleration and angular rate.

After the VN-100 User Manual (UM001), chapter "Asynchronous measurement outputs": ``$VN``, a name
of three letters, values with commas between, ``*``, and a checksum in hexadecimal digits: two of
an exclusive or, or four of a CRC-16.  The lines hold no time.
"""

from __future__ import annotations

from binascii import crc_hqx
from collections import Counter
from dataclasses import dataclass
from functools import reduce
from operator import xor
from typing import NamedTuple

from ...core import Increments, Parameters, Refusal, Vector
from ..sample import Sample, scaled
from .decoder import append_if_finite
from .framing import DelimitedFramer

START = b"$VN"
MAX_LINE = 256
GAUSS = 1e-4  # T


class Line(NamedTuple):
    """A kind of line: number of its values, and where those that are used begin."""

    values: int
    field: int
    force: int
    rate: int
    temperature: int | None = None


LINES = {
    "IMU": Line(11, 0, 3, 6, 9),  # uncompensated
    "MAR": Line(9, 0, 3, 6),
    "YMR": Line(12, 3, 6, 9),
    "QMR": Line(13, 4, 7, 10),
}


@dataclass(frozen=True)
class VectorNavAsciiConfig(Parameters):
    """No options: the names of the lines say what they hold."""


class VectorNavAsciiDecoder:
    """Decoder of ``$VNIMU``, ``$VNMAR``, ``$VNYMR`` and ``$VNQMR``."""

    message_oriented = False
    max_buffer = MAX_LINE

    def __init__(self, config: VectorNavAsciiConfig | None = None) -> None:
        """Start with an empty buffer."""
        self.counters: Counter[str] = Counter()
        self._framer = DelimitedFramer(ord("\n"), MAX_LINE, self.counters)

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-received line."""
        self._framer.reset()

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples of the lines that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for raw in self._framer.push(data):
            at = raw.rfind(START)  # garbage may stand before it
            if at < 0:
                self.counters[Refusal.GARBAGE_BYTES] += len(raw)
                continue
            self.counters[Refusal.GARBAGE_BYTES] += at
            self._take(raw[at:].strip(), arrival_ns, samples)
        return samples

    def _take(self, line: bytes, arrival_ns: int, samples: list[Sample]) -> None:
        body, star, checksum = line[1:].rpartition(b"*")
        if not star or not _is_right(body, checksum):
            self.counters[Refusal.BAD_CHECKSUM] += 1
            return
        name, *cells = body.decode("ascii", "replace").split(",")
        kind = LINES.get(name.removeprefix("VN"))
        if kind is None:
            self.counters[Refusal.OTHER] += 1
            return
        values = _read_values(cells)
        if values is None or len(values) != kind.values:
            self.counters[Refusal.MALFORMED] += 1
            return
        sample = Sample(
            arrival_ns,
            _vector(values, kind.force),
            _vector(values, kind.rate),
            temperature=None if kind.temperature is None else values[kind.temperature],
            magnetic_field=scaled(_vector(values, kind.field), GAUSS),
            increments=Increments.SAMPLED,
        )
        append_if_finite(self.counters, samples, sample)


def _is_right(body: bytes, checksum: bytes) -> bool:
    try:
        given = int(checksum, 16)
    except ValueError:
        return False
    if len(checksum) == 2:
        return given == reduce(xor, body, 0)
    return len(checksum) == 4 and given == crc_hqx(body, 0)


def _read_values(cells: list[str]) -> list[float] | None:
    if any("_" in cell for cell in cells):  # Python's float reads 1_0 as ten
        return None
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return None


def _vector(values: list[float], at: int) -> Vector:
    x, y, z = values[at : at + 3]
    return x, y, z
