"""Device counters as time: wraps undone, restarts and jumps recognised and counted."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...core import Parameters, parameter

BITS = ("16", "32", "64")
COUNTERS = ("counted", "wraps", "duplicates", "out_of_order", "restarts", "jumps")


@dataclass(frozen=True)
class CounterConfig(Parameters):
    """What kind of counter a device stamps its samples with."""

    bits: str = parameter("32", "width of the counter", choices=BITS)
    rate: float = parameter(
        1.0e6,
        "counts a second: 1e6 for microseconds, 1e3 for milliseconds, else that of the timer",
        unit="Hz",
        minimum=1.0e-3,
        maximum=1.0e9,
    )
    slack: float = parameter(
        2.0,
        "longest stall of the link; a larger disagreement with the arrivals is a restart",
        unit="s",
        minimum=0.01,
        maximum=3600.0,
    )
    max_gap: float = parameter(
        60.0,
        "longest step that is believed when there is no arrival to compare it with",
        unit="s",
        minimum=0.01,
        maximum=1.0e6,
    )

    @property
    def range(self) -> int:
        """Counts until the counter starts at zero again."""
        return 1 << int(self.bits)

    @property
    def period_ns(self) -> Fraction:
        """Nanoseconds of one count, exact."""
        return 1_000_000_000 / Fraction(self.rate).limit_denominator(1_000_000)


class Unwrapper:
    """Turn the counts of one device into int64 ns that do not wrap.

    Successive counts are taken as the shorter way round.  Where arrival times are given, whole
    turns of the counter during a gap are found from them, and a count that disagrees with them
    by more than ``slack`` begins a new ``epoch``: a ``restart`` when the count is smaller than
    before, else a ``jump``.  A count that just goes on is believed: the link had a long stall.
    A counter whose range is shorter than twice the slack (16 bits of microseconds: 66 ms) cannot
    tell a restart from a stall; there whole turns are rounded.

    ``counters`` holds ``counted``, ``wraps``, ``duplicates``, ``out_of_order``, ``restarts`` and
    ``jumps``.
    """

    def __init__(self, config: CounterConfig | None = None) -> None:
        self.config = config or CounterConfig()
        self._period = self.config.period_ns
        self._range = self.config.range
        self._slack_ns = round(self.config.slack * 1e9)
        self._gap_ns = round(self.config.max_gap * 1e9)
        self._newest: int | None = None  # counts, unwrapped
        self._arrival_ns: int | None = None
        self.counters = dict.fromkeys(COUNTERS, 0)
        self.epoch = 0

    def time_ns(self, count: int, arrival_ns: int | None = None) -> int:
        """Return the device time of ``count`` in ns since the counter's zero of this epoch.

        A count is taken modulo the range, so a sign bit or spare bits above do no harm.
        """
        count %= self._range
        self.counters["counted"] += 1
        if self._newest is None:
            return self._begin(count, arrival_ns)
        step = (count - self._newest) % self._range
        step -= self._range * (step >= self._range // 2)
        turns = self._turns(step, arrival_ns)
        if turns is None:
            self.counters["restarts" if count < self._newest % self._range else "jumps"] += 1
            self.epoch += 1
            return self._begin(count, arrival_ns)
        total = self._newest + step + turns * self._range
        self._note(total, arrival_ns)
        return self._ns(total)

    def _begin(self, count: int, arrival_ns: int | None) -> int:
        self._newest, self._arrival_ns = count, arrival_ns
        return self._ns(count)

    def _turns(self, step: int, arrival_ns: int | None) -> int | None:
        """Return whole turns of the counter to add to ``step``; None: it does not continue."""
        if arrival_ns is None or self._arrival_ns is None:
            return 0 if abs(self._ns(step)) <= self._gap_ns else None
        missing = arrival_ns - self._arrival_ns - self._ns(step)
        turn_ns = self._ns(self._range)
        goes_on = 0 <= self._ns(step) <= self._slack_ns and 0 <= 2 * missing < turn_ns
        if abs(missing) <= self._slack_ns or goes_on:  # a count that just goes on: a long stall
            return 0
        turns = max(0, (2 * missing + turn_ns) // (2 * turn_ns))
        return turns if abs(missing - turns * turn_ns) <= self._slack_ns else None

    def _note(self, total: int, arrival_ns: int | None) -> None:
        assert self._newest is not None
        if total <= self._newest:
            self.counters["duplicates" if total == self._newest else "out_of_order"] += 1
            return
        self.counters["wraps"] += total // self._range - self._newest // self._range
        self._newest, self._arrival_ns = total, arrival_ns

    def _ns(self, counts: int) -> int:
        return counts * self._period.numerator // self._period.denominator
