"""Xsens DOT, recorded: lines of the app's csv export, decoded as they are read.

The importer in ``recording`` reads a whole export at once and refuses a damaged one; this one
takes lines as they come (a file that is still being written, a pipe) and refuses only the damaged
lines.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from ...core import DEGREE, Increments, Parameters, Refusal, Vector, parameter
from ..sample import Sample, scaled
from .decoder import PacketCounter, append_if_finite
from .framing import DelimitedFramer

FIRST = "PacketCounter"
STAMP = "SampleTimeFine"
FORCE, RATE, FIELD = (tuple(f"{name}_{axis}" for axis in "XYZ") for name in ("Acc", "Gyr", "Mag"))
MAX_LINE = 1024
WHOLE = re.compile(r"\.0*$")  # data frames write counters as 7.0


@dataclass(frozen=True)
class DotCsvConfig(Parameters):
    """Options of the decoder of DOT csv lines."""

    field_unit: float = parameter(
        0.0,
        "T for 1 in the export's arbitrary unit; 0 leaves the magnetic field out",
        unit="T",
        minimum=0.0,
        maximum=1e-3,
    )


class DotCsvDecoder:
    """Decoder of the lines after the one that names the columns."""

    message_oriented = False
    max_buffer = MAX_LINE

    def __init__(self, config: DotCsvConfig | None = None) -> None:
        """Wait for the names of the columns."""
        self.counters: Counter[str] = Counter()
        self._framer = DelimitedFramer(ord("\n"), MAX_LINE, self.counters)
        self._packets = PacketCounter(self.counters, 32)
        self._field_unit = (config or DotCsvConfig()).field_unit
        self._columns: dict[str, int] | None = None
        self._delimiter = ","

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return self._framer.buffered

    def reset(self) -> None:
        """Forget a half-read line and the columns; a file that is opened anew names them."""
        self._framer.reset()
        self._packets.reset()
        self._columns = None

    def feed(self, data: bytes, arrival_ns: int) -> list[Sample]:
        """Return the samples of the lines that ``data`` completes."""
        self.counters["bytes"] += len(data)
        samples: list[Sample] = []
        for raw in self._framer.push(data):
            line = raw.decode("ascii", "replace").strip("\ufffd \r").replace('"', "")
            if line.startswith(FIRST):
                self._begin(line)
            elif self._columns is None or not line.strip(",;\t "):
                self.counters[Refusal.OTHER] += 1
            else:
                self._take(line.split(self._delimiter), arrival_ns, samples)
        return samples

    def _begin(self, line: str) -> None:
        """Read the names of the columns; without those that are needed nothing is decoded."""
        self._delimiter = next((sign for sign in "\t;" if sign in line), ",")
        names = [name.strip() for name in line.split(self._delimiter)]
        columns = {name: place for place, name in enumerate(names)}
        complete = all(name in columns for name in (STAMP, *FORCE, *RATE))
        self._columns = columns if complete else None
        self.counters[Refusal.INCOMPLETE] += not complete

    def _take(self, cells: list[str], arrival_ns: int, samples: list[Sample]) -> None:
        assert self._columns is not None
        try:
            counter, ticks = (self._read_whole(cells, name) for name in (FIRST, STAMP))
            force, rate = (self._read_vector(cells, names) for names in (FORCE, RATE))
            field = self._read_vector(cells, FIELD) if self._sends_field() else None
        except (ValueError, IndexError):
            self.counters[Refusal.MALFORMED] += 1
            return
        self._packets.count(counter)
        field = None if field is None else scaled(field, self._field_unit)
        sample = Sample(
            arrival_ns,
            force,
            scaled(rate, DEGREE),
            ticks,
            1000,
            32,
            magnetic_field=field,
            counter=counter,
            increments=Increments.COMPENSATED,
        )
        append_if_finite(self.counters, samples, sample)

    def _sends_field(self) -> bool:
        return bool(self._field_unit) and FIELD[0] in (self._columns or {})

    def _read_whole(self, cells: list[str], name: str) -> int:
        assert self._columns is not None
        cell = WHOLE.sub("", cells[self._columns[name]].strip())
        if not cell.isascii() or not cell.isdigit() or len(cell) > 10 or int(cell) >> 32:
            raise ValueError(cell)
        return int(cell)

    def _read_vector(self, cells: list[str], names: tuple[str, ...]) -> Vector:
        assert self._columns is not None
        texts = [cells[self._columns[name]] for name in names]
        if any("_" in text for text in texts):  # Python's float reads 1_0 as ten
            raise ValueError(texts)
        x, y, z = map(float, texts)
        return (x, y, z)
