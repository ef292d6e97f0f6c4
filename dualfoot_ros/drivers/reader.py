"""Thread that reads a transport, and opens it again when the link is lost."""

from __future__ import annotations

import contextlib
import enum
import threading
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from ..core import Parameters, parameter
from .transports.transport import Transport

FACTOR = 2.0
STOP_S = 15.0  # the longest that a transport may take to return from open or read


class State(enum.Enum):
    """State of a reader."""

    CONNECTING = "connecting"
    """The link is tried for the first time."""
    WAITING = "waiting"
    """The link cannot be made or was lost; it is tried again and again."""
    CONNECTED = "connected"
    ENDED = "ended"
    """The file is over."""
    FAILED = "failed"
    """A callback raised, or a file cannot be read; ``Reader.failure`` says what."""
    STOPPED = "stopped"


@dataclass(frozen=True)
class BackoffConfig(Parameters):
    """Waits before a lost link is tried again: twice as long each time."""

    retry_first: float = parameter(
        0.1, "wait before the first try", unit="s", minimum=0.001, maximum=60.0
    )
    retry_max: float = parameter(
        1.0, "longest wait between tries", unit="s", minimum=0.001, maximum=600.0
    )


class Reader:
    """Thread that reads a transport and hands on what comes.

    ``on_bytes(data, arrival_ns)`` and ``on_state(state, reason)`` are called from that thread.
    ``counters`` holds ``opened``, ``lost_links``, ``not_opened`` (failed tries) and
    ``received_bytes``.
    """

    def __init__(
        self,
        transport: Transport,
        on_bytes: Callable[[bytes, int], None],
        on_state: Callable[[State, str], None] | None = None,
        backoff: BackoffConfig | None = None,
        clock: Callable[[], int] = time.time_ns,
    ) -> None:
        """Prepare; :meth:`start` starts.  ``clock`` gives arrival times in ns."""
        self.counters: Counter[str] = Counter()
        self.state = State.STOPPED
        self.reason = "not started"
        self.failure: Exception | None = None
        self.stopping = threading.Event()
        self._transport = transport
        self._on_bytes = on_bytes
        self._on_state = on_state or (lambda state, reason: None)
        self._backoff = backoff or BackoffConfig()
        self._clock = clock
        self._wait_s = self._backoff.retry_first
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Start the thread; does nothing when it runs already."""
        if self._thread is None or not self._thread.is_alive():
            self.stopping.clear()
            self._thread = threading.Thread(
                target=self._run, name=f"read {self._transport.description}", daemon=True
            )
            self._thread.start()

    def stop(self) -> None:
        """Stop the thread and wait until it has given the transport back."""
        self.stopping.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(STOP_S)

    def _run(self) -> None:
        try:
            self._enter(State.CONNECTING, "")
            while self._session() and not self.stopping.wait(self._wait_s):
                self._wait_s = min(FACTOR * self._wait_s, self._backoff.retry_max)
            if self.state in (State.CONNECTING, State.WAITING, State.CONNECTED):
                self._enter(State.STOPPED, "")
        except Exception as error:
            self._fail(error)

    def _session(self) -> bool:
        """Open, read until the link is lost, close; return whether to try again."""
        try:
            try:
                self._transport.open()
            except OSError as error:
                return self._give_up("not_opened", error)
            self.counters["opened"] += 1
            self._enter(State.CONNECTED, "")
            return self._pump()
        finally:
            self._transport.close()

    def _pump(self) -> bool:
        """Hand on what comes; return whether the link is to be opened again."""
        last_s = time.monotonic()
        while not self.stopping.is_set():
            try:
                data = self._transport.read()
                now_s = time.monotonic()
                self._check_silence(now_s - last_s, data)
            except OSError as error:
                return self._give_up("lost_links", error)
            if data is None:
                self._enter(State.ENDED, "")
                return False
            if data:
                last_s = now_s
                self._wait_s = self._backoff.retry_first
                self.counters["received_bytes"] += len(data)
                self._on_bytes(data, self._clock())
        return False

    def _check_silence(self, silent_s: float, data: bytes | None) -> None:
        if data == b"" and 0.0 < self._transport.silence_s < silent_s:
            raise TimeoutError(f"nothing came for {silent_s:.1f} s")

    def _give_up(self, counter: str, error: OSError) -> bool:
        self.counters[counter] += 1
        if not self._transport.reopens:
            self._fail(error)
            return False
        self._enter(State.WAITING, str(error))
        return True

    def _fail(self, error: Exception) -> None:
        self.failure = error
        with contextlib.suppress(Exception):  # the callback may be what failed
            self._enter(State.FAILED, f"{type(error).__name__}: {error}")

    def _enter(self, state: State, reason: str) -> None:
        if (state, reason) != (self.state, self.reason):
            self.state, self.reason = state, reason
            self._on_state(state, reason)
