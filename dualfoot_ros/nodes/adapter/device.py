"""A sensor that the drivers read: its samples with the device's own time, and how it fares."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable

import numpy as np
from rclpy.node import Node

from ...core import FloatArray, SourceError, Vector
from ...drivers import Checks, Sample, Source, State, UdpTransport
from ...settings import Input as InputOptions
from ...timing import Counter, Unwrapper
from ..ros.diagnostics import ERROR, OK, WARN, Status
from ..ros.watched_input import Complaint, silence
from .losses import MIXED, REFUSED, in_words, increases

Take = Callable[[int | None, int, FloatArray, Vector | None], None]


class Device:
    """Hands on ``(device_ns or None, arrival_ns, values (6,), field (3,) T or None)``.

    It does so from a thread of its own.  ``begin`` is called from there, with the event that says
    stop, before the first sample: a file waits in it for its listeners.  So is ``ended``, once:
    without a reason when a file is over, with one when reading has failed for good.
    """

    def __init__(
        self,
        node: Node,
        uri: str,
        checks: Checks,
        options: InputOptions,
        take: Take,
        ended: Callable[[SourceError | None], None],
        begin: Callable[[threading.Event], None] | None = None,
    ) -> None:
        """Put it together; :meth:`start` starts.

        Raises
        ------
        SourceError
            When the URI, an option in it or the file it names is not allowed.
        """
        self._node, self._hand_on, self._ended, self._begin = node, take, ended, begin
        self._options = options
        self.without_time = 0
        self.temperature = math.nan
        self._unwrapper: Unwrapper | None = None
        self._last_s = time.monotonic()
        self._said = OK
        self._told = State.STOPPED
        self._at_last: dict[str, int] = {}  # what was counted when the last good sample came
        self._returns: dict[str, int] = {}
        self._sent: dict[str, int] = {}
        self.source = Source(
            uri,
            self._take,
            on_state=self._changed,
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
        self._last_s, self._at_last = time.monotonic(), self._counted()
        try:
            for sample in samples:
                values = np.array((*sample.specific_force, *sample.angular_rate))
                device_ns, field = self._device_ns(sample), sample.magnetic_field
                self._hand_on(device_ns, sample.arrival_ns, values, field)
        except Exception:
            if self._node.context.ok():
                raise
        if samples[-1].temperature is not None:
            self.temperature = samples[-1].temperature

    def _device_ns(self, sample: Sample) -> int | None:
        """Return the device's time without wraps, or None where it sends none."""
        if sample.ticks is None:
            self.without_time += 1
            return None
        if self._unwrapper is None:
            self._unwrapper = Unwrapper(
                Counter(bits=str(sample.tick_bits), rate=1e9 / sample.tick_ns)
            )
        return self._unwrapper.time_ns(sample.ticks, sample.arrival_ns)

    def _changed(self, state: State, reason: str) -> None:
        log, uri = self._node.get_logger(), self.source.uri
        if state is State.CONNECTED:
            if self.source.reader.counters["opened"] == 1:  # to open again is no sign of life
                self._last_s = time.monotonic()
            log.info(f"source '{uri}' is connected")
        elif state is State.WAITING and self._told is not State.WAITING:
            log.warning(f"source '{uri}' is not there and is tried again: {reason}")
        elif state is State.FAILED and self._node.context.ok():
            self._ended(SourceError(f"source '{uri}' has failed: {reason}"))
        elif state is State.ENDED:
            self._ended(self._emptiness())
        self._told = state

    def _wait_to_begin(self, stop: threading.Event) -> None:
        if self._begin is not None:
            self._last_s = math.inf  # waiting is no silence
            self._begin(stop)
            self._last_s = time.monotonic()

    def _emptiness(self) -> SourceError | None:
        """Return what to say of a file without any sample, or None when it had some."""
        found = self.source.decoder.counters
        if found["samples"]:
            return None
        return SourceError(
            f"source '{self.source.uri}' has no sample in {found['bytes']} bytes: check format"
        )

    def describe(self, status: Status) -> None:
        """Put link, decoder, checks and counter into a report."""
        status.values["link"] = self.source.state.value
        status.values["reconnects"] = max(0, self.source.reader.counters["opened"] - 1)
        status.values |= self.source.counters
        if not math.isnan(self.temperature):
            status.values["temperature (deg C)"] = self.temperature
        if self._unwrapper is not None:
            status.values |= {f"ticks {k}": n for k, n in self._unwrapper.counters.items()}
        if self.without_time:
            status.values["without_time"] = self.without_time
            status.note(WARN, "the device sends no time: its samples get that of their arrival")
        self._describe_senders(status)
        self._describe_silence(status)

    def _describe_senders(self, status: Status) -> None:
        """Say whose datagrams come, and warn when those of several devices mix."""
        if not isinstance(self.source.transport, UdpTransport):
            return
        samples, returns = dict(self.source.senders.samples), dict(self.source.senders.returns)
        status.values["senders"] = len(samples)
        if self.source.transport.strangers:
            status.values["foreign senders"] = self._strangers()
        back = [name for name, n in increases(returns, self._returns).items() if n > 0]
        sent = increases(samples, self._sent)
        self._returns, self._sent = returns, samples
        if len(back) > 1:
            names = ", ".join(f"{name} ({sent.get(name, 0)} samples)" for name in sorted(back))
            status.note(
                WARN,
                f"{len(back)} devices send to one port and their samples mix: {names}; give each "
                "a port of its own, or list the address of the right one in peers",
                MIXED,
            )

    def _strangers(self) -> str:
        assert isinstance(self.source.transport, UdpTransport)
        found = dict(self.source.transport.strangers)
        return ", ".join(f"{count} datagrams from {host}" for host, count in found.items())

    def _counted(self) -> dict[str, int]:
        """Return what was refused so far, by name."""
        parts = self.source.decoder, self.source.check, self.source.transport
        names = (*REFUSED, "foreign")
        return {name: sum(part.counters[name] for part in parts) for name in names}

    def _describe_silence(self, status: Status) -> None:
        complaint = self.complaint()
        if complaint is None:
            self._said = OK
            return
        status.note(*complaint)
        if self.source.state in (State.WAITING, State.FAILED):
            return  # that was said when it became so
        if complaint.level > self._said:
            self._node.get_logger().warning(complaint.message)
            self._said = complaint.level

    def complaint(self) -> Complaint | None:
        """Return why no sample comes, or None when samples do."""
        state, reason, uri = self.source.state, self.source.reader.reason, self.source.uri
        if state in (State.WAITING, State.FAILED):
            return Complaint(ERROR, f"source '{uri}' is {state.value}: {reason}")
        silent_s = time.monotonic() - self._last_s
        if state not in (State.CONNECTING, State.CONNECTED) or silent_s < self._options.silence:
            return None
        decoder = self.source.decoder.counters
        since = increases(self._counted(), self._at_last)
        if since["foreign"]:
            return Complaint(ERROR, self._misdirected())
        refused = in_words(since)
        if refused and (decoder["samples"] or decoder["not_finite"]):
            return Complaint(
                ERROR,
                f"source '{uri}' is {state.value} but nothing that came can be used for "
                f"{silent_s:.1f} s: {refused}",
            )
        if decoder["samples"] or not decoder["bytes"]:
            who = f"source '{uri}' is {state.value}"
            return silence(who, decoder["samples"] > 0, silent_s, self._options)
        return Complaint(
            ERROR,
            f"source '{uri}' sends bytes but no sample was found in {decoder['bytes']}: "
            "check format and baud, and what the device is set to send"
            + (f" ({refused})" if refused else ""),
        )

    def _misdirected(self) -> str:
        """Return what to say when datagrams come, from others than the peers."""
        assert isinstance(self.source.transport, UdpTransport)
        peers = ", ".join(sorted(self.source.transport.peers))
        return (
            f"source '{self.source.uri}' takes nothing: it got {self._strangers()}, which is not "
            f"among the peers ({peers}): check peers"
        )
