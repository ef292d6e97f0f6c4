"""The clock of a device, followed on the host's clock from arrivals alone, sample by sample."""

from __future__ import annotations

from .clock_config import DeviceClockConfig
from .connection_events import ConnectionEvents
from .envelope import LowerEnvelope
from .line import Line
from .outliers import Arrival, LateArrivals, Suspects
from .settling import SURE, Settling
from .slew import SlewedTime
from .state import ClockState

COUNTERS = ("arrivals", "settling", "late", "early", "bad_skew", "restarts", "jumps")
OLD_NS = 1_000_000_000  # a stamp that much before the newest is no late sample
STEER_NS = 100_000_000
ACQUIRING_SLEW, ACQUIRING_TIME_S = 0.4, 0.1
DOUBT = 25.0  # natural log of the odds at which a shift of all arrivals is no chance


class DeviceClock:
    """Translate the stamps of one device to the host's clock.

    Host times are strictly increasing with device times and never step, except at the beginning
    of a new ``epoch`` (the device restarted, or a clock jumped).  While tracking, corrections
    run at ``max_slew`` at most.  What is translated is the time of the *fastest possible*
    arrival: a least delay that is always there is part of the offset, unless ``config.delay``
    takes it off.

    At first samples are withheld, until the clock is known well enough (:class:`Settling`).  That
    is so once only: after a restart or a jump stamps go on, as a walk may be under way.

    ``counters`` holds ``arrivals``, ``settling`` (samples withheld at first), ``late`` (samples
    out of order), ``early`` (arrivals that contradict all others and were left out),
    ``bad_skew`` (samples refused for it), ``restarts`` (the device's time went back) and
    ``jumps`` (either clock was set).
    """

    def __init__(self, config: DeviceClockConfig | None = None) -> None:
        self.config = config or DeviceClockConfig()
        self.counters = dict.fromkeys(COUNTERS, 0)
        self.epoch = 0
        self._jump_ns = round(self.config.jump * 1e9)
        self._delay_ns = round(self.config.delay * 1e9)
        self._time: SlewedTime | None = None
        self._settling = Settling(self.config)

    def update(self, device_ns: int, arrival_ns: int) -> int | None:
        """Learn from one sample and return its host time in ns; None: it is not to be used.

        None is returned while too little is known at first, for stamps that contradict all others
        by more than ``config.jump``, and for a clock with a skew beyond ``config.max_skew``; all
        are counted.
        """
        arrival = Arrival(int(device_ns), int(arrival_ns))
        self._arrived_ns = arrival.arrival_ns
        self.counters["arrivals"] += 1
        if self._time is None:
            self._begin([arrival])
        elif not self._take(arrival):
            return None
        if self._phase(self._line) == "refused":
            self.counters["bad_skew"] += 1
            return None
        if self._withheld():
            self.counters["settling"] += 1
            return None
        return self.translate(arrival.device_ns)

    def translate(self, device_ns: int) -> int | None:
        """Return the host time in ns of a device time; None before the first sample."""
        return None if self._time is None else self._time.at(device_ns) - self._delay_ns

    def line_at(self, device_ns: int) -> tuple[int, float]:
        """Return host minus device (ns) at a device time by the line as it is now, and its std.

        The standard deviation is in s.  Only after the first sample.
        """
        std_s = self._line.std_at(self._seconds(device_ns))
        return self._offset_ns(device_ns) - self._delay_ns, std_s

    def restart(self) -> None:
        """Forget the clock (the device's driver saw it restart); the counters stay."""
        if self._time is not None:
            self.counters["restarts"] += 1
            self.epoch += 1
            self._time = None

    @property
    def state(self) -> ClockState:
        """What is known now."""
        if self._time is None:
            nan = float("nan")
            return ClockState("empty", 0.0, 0, nan, nan, nan, nan, nan, self.epoch)
        line, now_s = self._line, self._seconds(self._newest_ns)
        return ClockState(
            phase=self._phase(line),
            age_s=1e-9 * (self._arrived_ns - self._begun_ns),
            offset_ns=self._offset_ns(self._newest_ns) - self._delay_ns,
            offset_std_s=line.std_at(now_s),
            skew_ppm=1e6 * (1.0 / (1.0 + line.skew) - 1.0),
            skew_std_ppm=1e6 * line.skew_var**0.5,
            delay_s=self._envelope.scale_s,
            interval_s=self._events.interval_s or float("nan"),
            epoch=self.epoch,
        )

    def _begin(self, arrivals: list[Arrival]) -> None:
        """Start anew from a few arrivals, oldest first."""
        config, first = self.config, arrivals[0]
        self._origin_ns = first.device_ns
        self._begun_ns, self._base_ns = first.arrival_ns, first.arrival_ns - first.device_ns
        self._envelope = LowerEnvelope(config.bin, config.bins, 1e-6 * config.skew_scale)
        self._events = ConnectionEvents(config.bin, config.bins)
        self._suspects = Suspects()
        self._settling.begin()
        self._late = LateArrivals(round(1e9 * config.bin))
        self._tracking = False
        for device_ns, arrival_ns in arrivals:
            self._learn(device_ns, arrival_ns)
        self._newest_ns = max(a.device_ns for a in arrivals)
        self._time = self._on_the_line()

    def _on_the_line(self) -> SlewedTime:
        now_ns = self._newest_ns
        return SlewedTime(now_ns, now_ns + self._offset_ns(now_ns), self._line.skew)

    def _withheld(self) -> bool:
        """Tell whether too little is known to use the sample that has just come."""
        now_s = self._seconds(self._newest_ns)
        if self._settling.ends(self._arrived_ns, self._envelope, now_s):
            self._time = self._on_the_line()  # nothing was stamped so far that it has to meet
        return not self._settling.over

    def _take(self, arrival: Arrival) -> bool:
        """Learn from a sample; return False when it is not to be used."""
        device_ns, arrival_ns = arrival
        above_ns = arrival_ns - device_ns - self._offset_ns(device_ns)
        if above_ns < -self._gate_ns(device_ns) or device_ns < self._newest_ns - OLD_NS:
            return self._suspect(arrival, above_ns)
        self._suspects.contradict()
        self.counters["late"] += device_ns < self._newest_ns
        fitted = self._learn(device_ns, arrival_ns)
        if self._all_late(arrival, 1e-9 * above_ns):
            self._jump_up()
        self._steer(device_ns, fitted)
        return True

    def _suspect(self, arrival: Arrival, above_ns: int) -> bool:
        """Hold a sample that cannot be; return whether it may be used all the same."""
        self.counters["early"] += self._suspects.hold(arrival)
        small = -self._jump_ns <= above_ns and arrival.device_ns >= self._newest_ns - OLD_NS
        settled = self._tracking and not small
        if self._suspects.confirmed and (self._suspects.alone or not settled):
            back = arrival.device_ns < self._newest_ns - OLD_NS
            held = self._suspects.release()
            if back or settled:
                self._restart("restarts" if back else "jumps", held)
            else:
                self._admit(held)
            return True
        return small or (not self._tracking and above_ns > -OLD_NS)

    def _admit(self, held: list[Arrival]) -> None:
        for device_ns, arrival_ns in held:
            self._learn(device_ns, arrival_ns)
        self._steer(max(a.device_ns for a in held), True)

    def _restart(self, counter: str, arrivals: list[Arrival]) -> None:
        self.counters[counter] += 1
        self.epoch += 1
        self._begin(arrivals)

    def _all_late(self, arrival: Arrival, above_s: float) -> bool:
        """Tell whether every arrival of the last seconds was later than chance allows."""
        late = self._late
        if above_s <= self.config.jump:
            late.end()
            return False
        late.add(arrival, above_s)
        odds = late.steps * late.least_s / self._envelope.scale_s
        return late.steps * self.config.bin >= self.config.jump_after and odds > DOUBT

    def _jump_up(self) -> None:
        assert self._late.since is not None
        since_s = self._seconds(self._late.since.device_ns)
        late = [point for point in self._envelope.points if point[0] >= since_s]
        arrivals = [
            Arrival(device := self._origin_ns + round(1e9 * t), device + self._base_ns + round(y))
            for t, y in ((t, 1e9 * y) for t, y in late)
        ]
        self._restart("jumps", arrivals)

    def _learn(self, device_ns: int, arrival_ns: int) -> bool:
        time_s, arrival_s = self._seconds(device_ns), 1e-9 * (arrival_ns - self._begun_ns)
        whole, interval_s = self._events.add(time_s, arrival_s), self._events.interval_s
        if interval_s is None:
            self._envelope.unbound()
        else:
            for then_s, event_s in whole:
                self._envelope.bound(then_s, event_s - then_s, interval_s)
        return self._envelope.add(time_s, arrival_s - time_s)

    def _steer(self, device_ns: int, fitted: bool) -> None:
        """Let the translated time run towards the line."""
        self._newest_ns = max(self._newest_ns, device_ns)
        time, now_ns = self._time, self._newest_ns
        assert time is not None
        since_ns = now_ns - time.newest.device_ns
        if since_ns <= 0 or not (fitted or since_ns >= STEER_NS):
            return
        ahead_s = 1e-9 * (now_ns + self._offset_ns(now_ns) - time.at(now_ns))
        self._tracking = self._tracking or self._settled(ahead_s)
        limit, within_s = ACQUIRING_SLEW, ACQUIRING_TIME_S
        if self._tracking:
            limit, within_s = 1e-6 * self.config.max_slew, self.config.time_constant
        time.steer(now_ns, self._line.skew, max(-limit, min(limit, ahead_s / within_s)))

    def _settled(self, ahead_s: float) -> bool:
        std_s = self._line.std_at(self._seconds(self._newest_ns))
        enough = self._envelope.span_s >= self.config.settle and std_s < self.config.tracking_std
        return enough and abs(ahead_s) < self.config.tracking_std

    def _phase(self, line: Line) -> str:
        surely = abs(line.skew) - SURE * line.skew_var**0.5
        if surely > 1e-6 * self.config.max_skew and self._envelope.span_s >= self.config.settle:
            return "refused"
        if not self._settling.over:
            return "settling"
        return "tracking" if self._tracking else "acquiring"

    def _gate_ns(self, device_ns: int) -> int:
        """Return how far below the line an arrival may be by chance, ns."""
        return round(1e9 * max(0.005, 8.0 * self._line.std_at(self._seconds(device_ns))))

    @property
    def _line(self) -> Line:
        line = self._envelope.line
        assert line is not None
        return line

    def _offset_ns(self, device_ns: int) -> int:
        """Return host minus device by the line, ns."""
        return self._base_ns + round(1e9 * self._line.at(self._seconds(device_ns)))

    def _seconds(self, device_ns: int) -> float:
        return 1e-9 * (device_ns - self._origin_ns)
