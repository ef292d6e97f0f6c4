"""Device: a sensor read by the drivers, its samples with its own time, and its state."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable

import numpy as np
from rclpy.node import Node

from ...core import FloatArray, Increments, Refusal, SourceError, Vector
from ...drivers import CheckConfig, Sample, Source, State, recognise
from ...inspection import Finding, FindingKind, Severity
from ...settings import InputConfig
from ...timing import CounterConfig, Unwrapper
from ..ros.status import Status
from ..ros.watched_input import silence
from .losses import REFUSED, in_words, increases

PROBE = "'dualfoot probe URI' tries the usual ones"
Take = Callable[[int | None, int, FloatArray, Vector | None], None]
Declare = Callable[[Increments | None], None]


class Device:
    """A sensor whose samples are handed to ``take`` from a thread of its own.

    ``take`` is called with device time (ns, or None), arrival (ns), values (6,) and field (3,) T
    or None; before a sample of another kind than the last one, ``declare`` with what it is.
    ``begin`` is called from the same thread before the first sample, with an event that
    is set when the device is stopped: a file waits there for its listeners.  ``ended`` is called
    once: without a reason when a file is over, with one when reading has failed for good.
    """

    def __init__(
        self,
        node: Node,
        uri: str,
        checks: CheckConfig,
        config: InputConfig,
        take: Take,
        ended: Callable[[SourceError | None], None],
        *,
        begin: Callable[[threading.Event], None] | None = None,
        declare: Declare = lambda kind: None,
    ) -> None:
        """Put it together; :meth:`start` starts.

        Raises
        ------
        SourceError
            When the URI, an option in it or the file it names is not allowed.
        """
        self._node, self._hand_on, self._ended, self._begin = node, take, ended, begin
        self._declare = declare
        self._kind: Increments | None = None
        self._config = config
        self.without_time = 0
        self.temperature = math.nan
        self._unwrapper: Unwrapper | None = None
        self._last_s = time.monotonic()
        self._logged_rank = 0
        self._state = State.STOPPED
        self._at_last: dict[str, int] = {}  # the refusals, when the last good sample came
        self._returns: dict[str, int] = {}
        self._sent: dict[str, int] = {}
        self._looks_like: str | None = None
        self.source = Source(
            uri,
            self._take,
            on_state=self._change,
            checks=checks,
            clock=lambda: int(node.get_clock().now().nanoseconds),
            before_first=self._wait_to_begin,
        )

    def start(self) -> None:
        """Begin to read."""
        self.source.start()

    def stop(self) -> None:
        """Stop reading; nothing is handed on after this."""
        self.source.stop()

    def _take(self, samples: list[Sample]) -> None:
        self._last_s, self._at_last = time.monotonic(), self._count_refused()
        try:
            for sample in samples:
                if sample.increments is not self._kind:
                    self._kind = sample.increments
                    self._declare(self._kind)
                values = np.array((*sample.specific_force, *sample.angular_rate))
                device_ns, field = self._read_time(sample), sample.magnetic_field
                self._hand_on(device_ns, sample.arrival_ns, values, field)
        except Exception:
            if self._node.context.ok():
                raise
        if samples[-1].temperature is not None:
            self.temperature = samples[-1].temperature

    def _read_time(self, sample: Sample) -> int | None:
        """Return the device's time in ns without wraps, or None where it sends none."""
        if sample.ticks is None:
            self.without_time += 1
            return None
        if self._unwrapper is None:
            self._unwrapper = Unwrapper(
                CounterConfig(bits=str(sample.tick_bits), rate=1e9 / sample.tick_ns)
            )
        return self._unwrapper.time_ns(sample.ticks, sample.arrival_ns)

    def _change(self, state: State, reason: str) -> None:
        log, uri = self._node.get_logger(), self.source.uri
        if state is State.CONNECTED:
            if self.source.reader.counters["opened"] == 1:  # opening again shows nothing
                self._last_s = time.monotonic()
            log.info(f"source '{uri}' is connected")
        elif state is State.WAITING and self._state is not State.WAITING:
            log.warning(f"source '{uri}' is not available and is tried again: {reason}")
        elif state is State.FAILED and self._node.context.ok():
            self._ended(SourceError(f"source '{uri}' has failed: {reason}"))
        elif state is State.ENDED:
            self._ended(self._check_empty())
        self._state = state

    def _wait_to_begin(self, stop: threading.Event) -> None:
        if self._begin is not None:
            self._last_s = math.inf  # who waits is not silent
            self._begin(stop)
            self._last_s = time.monotonic()

    def _check_empty(self) -> SourceError | None:
        """Return an error for a file without any sample, None when it had some."""
        counters = self.source.decoder.counters
        if counters["samples"]:
            return None
        return SourceError(
            f"source '{self.source.uri}' has no sample in {counters['bytes']} bytes: check format"
            f"{self._recognise()}"
        )

    def _recognise(self) -> str:
        """Return what the bytes without samples look like, to end a sentence with."""
        if self._looks_like is None:
            found = recognise(list(self.source.unread))
            if found:
                self._looks_like = f"; {found[0].sentence}"
            elif self.source.uri.startswith("serial:"):
                self._looks_like = "; no known format is in them, as at a wrong baud: " + PROBE
            else:
                self._looks_like = ""
        return self._looks_like

    def describe(self, status: Status) -> None:
        """Add link, decoder, checks and device time to a status."""
        status.values["link"] = self.source.state.value
        status.values["reconnects"] = max(0, self.source.reader.counters["opened"] - 1)
        status.values |= self.source.counters
        if not math.isnan(self.temperature):
            status.values["temperature (deg C)"] = self.temperature
        if self._unwrapper is not None:
            status.values |= {f"ticks {k}": n for k, n in self._unwrapper.counters.items()}
        if self.without_time:
            status.values["without_time"] = self.without_time
            text = "the device sends no time: its samples get that of their arrival"
            status.note(Finding(FindingKind.NO_DEVICE_TIME, Severity.WARNING, text))
        self._describe_senders(status)
        self._describe_silence(status)

    def _describe_senders(self, status: Status) -> None:
        """Add the senders, and a warning when the samples of several devices mix."""
        if not self.source.transport.connectionless:
            return
        samples, returns = dict(self.source.senders.samples), dict(self.source.senders.returns)
        status.values["senders"] = len(samples)
        if self.source.transport.strangers:
            status.values["foreign senders"] = self._list_strangers()
        back = [name for name, n in increases(returns, self._returns).items() if n > 0]
        sent = increases(samples, self._sent)
        self._returns, self._sent = returns, samples
        if len(back) > 1:
            names = ", ".join(f"{name} ({sent.get(name, 0)} samples)" for name in sorted(back))
            text = f"{len(back)} devices send to one port and their samples mix: {names}"
            remedy = "give each a port of its own, or list the address of the right one in peers"
            status.note(Finding(FindingKind.MIXED_SENDERS, Severity.WARNING, text, remedy))

    def _list_strangers(self) -> str:
        strangers = dict(self.source.transport.strangers)
        return ", ".join(f"{count} datagrams from {host}" for host, count in strangers.items())

    def _count_refused(self) -> dict[str, int]:
        """Return the refusals so far, by reason."""
        parts = self.source.decoder, self.source.check, self.source.transport
        reasons = (*REFUSED, Refusal.FOREIGN)
        return {reason: sum(part.counters[reason] for part in parts) for reason in reasons}

    def _describe_silence(self, status: Status) -> None:
        complaint = self.complaint()
        if complaint is None:
            self._logged_rank = 0
            return
        status.note(complaint)
        if complaint.kind is FindingKind.LINK_DOWN:
            return  # it was logged when it went down
        if complaint.severity.rank > self._logged_rank:
            self._node.get_logger().warning(complaint.sentence)
            self._logged_rank = complaint.severity.rank

    def complaint(self) -> Finding | None:
        """Return why no sample comes, or None when samples do."""
        state, reason, uri = self.source.state, self.source.reader.reason, self.source.uri
        who = f"source '{uri}' is {state.value}"
        if state in (State.WAITING, State.FAILED):
            return Finding(FindingKind.LINK_DOWN, Severity.ERROR, f"{who}: {reason}")
        silent_s = time.monotonic() - self._last_s
        if state not in (State.CONNECTING, State.CONNECTED) or silent_s < self._config.silence:
            return None
        counters = self.source.decoder.counters
        refused = increases(self._count_refused(), self._at_last)
        if refused[Refusal.FOREIGN]:
            text = self._describe_strangers()
            return Finding(FindingKind.STRANGERS_ONLY, Severity.ERROR, text)
        reasons = in_words(refused)
        if reasons and (counters["samples"] or counters[Refusal.NOT_FINITE]):
            text = f"{who} but nothing that came can be used for {silent_s:.1f} s: {reasons}"
            return Finding(FindingKind.NOTHING_USABLE, Severity.ERROR, text)
        if counters["samples"] or not counters["bytes"]:
            return silence(who, counters["samples"] > 0, silent_s, self._config)
        text = (
            f"source '{uri}' sends bytes but no sample was found in {counters['bytes']} of them: "
            "check format and baud, and what the device is set to send"
        )
        text += f" ({reasons})" if reasons else ""
        text += self._recognise()
        return Finding(FindingKind.NO_FRAMES, Severity.ERROR, text)

    def _describe_strangers(self) -> str:
        """Return the text about datagrams that come from others than the peers only."""
        peers = ", ".join(sorted(self.source.transport.peers))
        return (
            f"source '{self.source.uri}' accepts nothing: it received {self._list_strangers()}, "
            f"which is not among the peers ({peers}): check peers"
        )
