"""Source of samples: transport, thread, decoder and checks, put together from one URI."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self

from ..core import Refusal
from .checks import CheckConfig, SensorCheck
from .conditioning import Conditioner, ConditioningConfig
from .protocols.registry import make_decoder
from .reader import Reader, State
from .sample import Sample
from .transports import address
from .transports.ble import BleConfig, BleTransport
from .transports.capture_file import FileConfig, FileTransport
from .transports.pacing import Pacer
from .transports.senders import Senders
from .transports.serial_port import SerialConfig, SerialTransport
from .transports.tcp import TcpConfig, TcpTransport
from .transports.transport import Transport
from .transports.udp import UdpConfig, UdpTransport
from .uri import SourceUri, parse_uri

UNREAD_BYTES = 8192
LEAVES_A_HOLE = (Refusal.LOST, Refusal.NOT_FINITE, Refusal.BAD_CHECKSUM, Refusal.MALFORMED)


class Source:
    """Samples of one device, handed to ``on_samples`` from a thread of the source's own.

    ``with Source(uri, on_samples):`` starts it and stops it.  ``on_state`` is called when the
    link comes and goes, with a reason in words.  ``before_first`` is called before the first
    samples are handed on, with an event that is set when the source is stopped: a file may wait
    there for its listeners.  ``unread`` holds the first bytes until one brought a sample.
    """

    def __init__(
        self,
        uri: str,
        on_samples: Callable[[list[Sample]], None],
        *,
        on_state: Callable[[State, str], None] | None = None,
        conditioning: ConditioningConfig | None = None,
        checks: CheckConfig | None = None,
        clock: Callable[[], int] = time.time_ns,
        before_first: Callable[[threading.Event], None] | None = None,
    ) -> None:
        """Put the source together; nothing is opened before :meth:`start`.

        Raises
        ------
        ConfigError
            When the axes are not allowed.
        SourceError
            When the URI or the file it names is not, or bleak is missing.
        """
        parsed = parse_uri(uri)
        self.uri = uri
        self.decoder = make_decoder(parsed.format, parsed.decoder)
        self.transport = make_transport(parsed)
        self.check = SensorCheck(checks)
        self.senders = Senders()
        self.reader = Reader(self.transport, self._take, self._change, parsed.backoff, clock)
        self.unread: list[bytes] = []
        self._conditioner = Conditioner(conditioning)
        self._on_samples = on_samples
        self._on_state = on_state or (lambda state, reason: None)
        self._before_first = before_first
        self._pacer = _make_pacer(self.transport.speed, self.reader.stopping, clock)

    def start(self) -> None:
        """Start reading."""
        self.reader.start()

    def stop(self) -> None:
        """Stop reading; no callback comes after this returns."""
        self.reader.stop()

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    @property
    def state(self) -> State:
        """State of the link."""
        return self.reader.state

    @property
    def counters(self) -> dict[str, int]:
        """Everything that is counted: by the link, the decoder and the checks."""
        parts = self.reader, self.transport, self.decoder, self.check
        return {name: n for part in parts for name, n in part.counters.items() if n}

    def _change(self, state: State, reason: str) -> None:
        if state is State.CONNECTED:
            self.decoder.reset()
        self._on_state(state, reason)

    def _take(self, data: bytes, arrival_ns: int) -> None:
        missing = self._count_missing()
        self._keep(data)
        decoded = self.decoder.feed(data, arrival_ns)
        whole = self._count_missing() == missing
        if decoded and self.transport.sender:
            self.senders.count(self.transport.sender, len(decoded))
        samples = [s for s in map(self._conditioner.apply, decoded) if self._accept(s, whole)]
        if not whole:
            self.check.interrupt()
        if samples:
            self._deliver(samples)

    def _keep(self, data: bytes) -> None:
        """Keep bytes as long as they bring no sample, to recognise what they are."""
        if self.decoder.counters["samples"]:
            self.unread.clear()
        elif sum(map(len, self.unread)) < UNREAD_BYTES:
            self.unread.append(data)

    def _count_missing(self) -> int:
        return sum(self.decoder.counters[reason] for reason in LEAVES_A_HOLE)

    def _accept(self, sample: Sample, whole: bool) -> bool:
        """Check a sample of a piece that is ``whole``, or has holes at unknown places."""
        if not whole:
            self.check.interrupt()
        return self.check.accept(sample)

    def _deliver(self, samples: list[Sample]) -> None:
        if self._before_first is not None:
            self._before_first(self.reader.stopping)
            self._before_first = None
            if self.reader.stopping.is_set():
                return
        if self._pacer is not None:
            self._pacer.deliver(samples, self._on_samples)
        else:
            self._on_samples(samples)


def make_transport(uri: SourceUri) -> Transport:
    """Return the transport that a URI asks for, not yet open.

    Raises
    ------
    SourceError
        When the address is malformed, the file is absent or bleak is missing.
    """
    match uri.transport:
        case SerialConfig():
            return SerialTransport(uri.location, uri.transport)
        case UdpConfig():
            return UdpTransport(address.parse(uri.location), uri.transport)
        case TcpConfig():
            return TcpTransport(address.parse(uri.location), uri.transport)
        case BleConfig():
            return BleTransport(uri.location, uri.transport, uri.decoder)
        case FileConfig():
            return FileTransport(uri.location, uri.transport)
    raise AssertionError(uri)


def _make_pacer(speed: float, stopping: threading.Event, clock: Callable[[], int]) -> Pacer | None:
    return Pacer(speed, stopping, clock) if speed > 0.0 else None
