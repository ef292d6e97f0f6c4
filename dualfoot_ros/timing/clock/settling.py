"""The first seconds of a clock: when enough is known about it to stamp with it."""

from __future__ import annotations

from .clock_config import DeviceClockConfig
from .envelope import LowerEnvelope
from .line import Line

ARRIVALS = 30  # at different times: the fastest of so few bursts may still be a slow one
SURE = 3.0  # standard deviations


class Settling:
    """Tells when samples may be stamped; once they were, there is no way back.

    The line is judged as it is without any belief in usual crystals, of which a clock that is far
    off would profit: for that a skew as large as ``max_skew`` is as good as any.  It is over when

    - the skew is surely within ``max_skew``, and
    - the offset is known to ``tracking_std`` from enough arrivals, or ``settle`` has passed.
    """

    def __init__(self, config: DeviceClockConfig) -> None:
        self._config = config
        self.over = False
        self.begin()

    def begin(self) -> None:
        """Learn that the clock begins anew."""
        self._arrivals = 0
        self._newest_ns: int | None = None
        self._judged: Line | None = None

    def ends(self, arrival_ns: int, envelope: LowerEnvelope, time_s: float) -> bool:
        """Take one arrival, which ``envelope`` has; return whether it is over with this one.

        ``time_s`` is the device's time for the envelope.
        """
        if self.over:
            return False
        self._arrivals += arrival_ns != self._newest_ns
        self._newest_ns = arrival_ns
        if envelope.line is not self._judged:  # refitted: at least once a bin
            self._judged = envelope.line
            self.over = self._known(envelope, time_s)
        return self.over

    def _known(self, envelope: LowerEnvelope, time_s: float) -> bool:
        line = envelope.fit(1e-6 * self._config.max_skew)
        if abs(line.skew) + SURE * line.skew_var**0.5 > 1e-6 * self._config.max_skew:
            return False
        good = line.std_at(time_s) < self._config.tracking_std and self._arrivals >= ARRIVALS
        return good or envelope.span_s >= self._config.settle
