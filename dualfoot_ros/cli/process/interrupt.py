"""Ctrl-C ends the command within a second, with one sentence and 130, wherever it strikes.

Python raises KeyboardInterrupt at whatever line is running.  In the middle of an import that may
be in a callback, which can only print it and go on, or in code that makes another exception of
it; and a compiled function has to return first.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from contextlib import suppress
from types import FrameType, TracebackType
from typing import Any

EXIT_INTERRUPTED = 130
GRACE_S = 0.5


class Interruptible:
    """A ``with`` block of the main thread that SIGINT ends, and the process with it.

    First as a KeyboardInterrupt, so that what was begun is put in order; when that has not got
    through after ``GRACE_S``, without.  A SIGINT that is ignored stays so.
    """

    def __init__(self, sentence: str) -> None:
        self._sentence = sentence
        self._came = self._leaving = False
        self._over = threading.Event()
        self._last = threading.Lock()

    def __enter__(self) -> Interruptible:
        self._handler = signal.getsignal(signal.SIGINT)
        if self._handler is not signal.default_int_handler:
            return self
        self._unraisable, sys.unraisablehook = sys.unraisablehook, self._drop
        self._read, self._write = os.pipe()
        os.set_blocking(self._write, False)
        self._wakeup = signal.set_wakeup_fd(self._write, warn_on_full_buffer=False)
        signal.signal(signal.SIGINT, self._raise)
        self._watch = threading.Thread(target=self._wait, name="interrupt", daemon=True)
        self._watch.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._leaving = True
        if self._came:
            self._end()
            threading.Event().wait()  # the watching thread is at it
        if self._handler is not signal.default_int_handler:
            return
        signal.signal(signal.SIGINT, self._handler)
        signal.set_wakeup_fd(self._wakeup)
        self._over.set()
        os.write(self._write, b"\0")
        self._watch.join()
        os.close(self._read)
        os.close(self._write)
        sys.unraisablehook = self._unraisable

    def _raise(self, number: int, frame: FrameType | None) -> None:
        self._came = True
        if not self._leaving:
            raise KeyboardInterrupt
        self._end()

    def _wait(self) -> None:
        """Wait for SIGINT, which writes its number at once, whatever the main thread does."""
        while not self._over.is_set():
            if os.read(self._read, 1) == bytes([signal.SIGINT]):
                while not self._over.wait(GRACE_S) and _putting_in_order():
                    pass
                if not self._over.is_set():
                    self._end()

    def _end(self) -> None:
        """End the process; Python's own way out takes time, and may end it by a signal."""
        if not self._last.acquire(blocking=False):
            return  # it is being ended
        _kill_workers()
        with suppress(OSError):
            os.write(2, f"{self._sentence}\n".encode())
        os._exit(EXIT_INTERRUPTED)

    def _drop(self, unraisable: Any) -> None:
        """Print what could not be raised, but for the KeyboardInterrupt."""
        if not issubclass(unraisable.exc_type, KeyboardInterrupt):
            self._unraisable(unraisable)


def _kill_workers() -> None:
    """End the processes that this one has started, where no ``finally`` has got to it."""
    started = sys.modules.get("multiprocessing")
    with suppress(Exception):  # the main thread may be in the midst of starting or ending one
        for process in started.active_children() if started else ():
            process.kill()
    server = sys.modules.get("dualfoot_ros.fork_server")
    with suppress(Exception):
        if server:
            server.kill_fork_server()


def _putting_in_order() -> bool:
    """Tell whether the main thread is in a ``finally`` or the like for a KeyboardInterrupt."""
    current: Any = sys._current_exceptions()  # noqa: SLF001 - documented, there is no other way
    handled = current.get(threading.main_thread().ident or 0)
    error = handled[1] if isinstance(handled, tuple) else handled  # a tuple until Python 3.11
    return isinstance(error, KeyboardInterrupt)
