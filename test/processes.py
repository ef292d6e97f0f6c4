"""Processes of their own session that tests start, interrupt and look at, by what /proc tells.

Time is measured as CPU time, which a busy machine does not stretch.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PATIENCE_S = 600.0  # guards against hanging for ever, and judges nothing
TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")


@contextmanager
def default_signals() -> Iterator[None]:
    """Let processes that are started here take SIGINT and SIGTERM as from a terminal.

    A shell that starts the tests in the background hands on an ignored SIGINT.  A handler is not
    handed on: the process gets the default.
    """
    handlers = {
        signal.SIGINT: signal.default_int_handler,
        signal.SIGTERM: lambda *_: sys.exit(143),
    }
    before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def environment() -> dict[str, str]:
    """Return the environment in which a process imports this checkout."""
    paths = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


@dataclass(frozen=True)
class Ended:
    """What a session was when it had ended."""

    code: int
    out: str
    error: str
    cpu_s: float


class Session:
    """A Python process with all that it starts."""

    def __init__(self, *arguments: object, **options) -> None:
        self._out = tempfile.TemporaryFile("w+")  # noqa: SIM115 (closed by `close`)
        self._error = tempfile.TemporaryFile("w+")  # noqa: SIM115
        command = [sys.executable, *map(str, arguments)]
        with default_signals():
            self._process = subprocess.Popen(
                command,
                stdout=self._out,
                stderr=self._error,
                env=environment(),
                start_new_session=True,
                **options,
            )
        self.pid = self._process.pid
        self._reaped_s: float | None = None

    def until(self, condition: Callable[["Session"], object], said: str = "") -> bool:
        """Wait for ``condition``; return whether it came before the end of the process."""
        deadline = time.monotonic() + PATIENCE_S
        while not condition(self):
            assert time.monotonic() < deadline, f"waited in vain: {said}\n{self.said()}"
            if not self.runs():
                return False
            time.sleep(0.01)
        return True

    def runs(self) -> bool:
        """Tell whether the first process has not ended; it is not reaped."""
        fields = _status(self.pid)
        return self._process.returncode is None and bool(fields) and fields[0] != b"Z"

    def others(self) -> list[int]:
        """Return the processes that were started, without those that keep the books."""
        return [
            pid
            for pid in _alive(self.pid)
            if pid != self.pid and b"resource_tracker" not in _read(pid, "cmdline")
        ]

    def forked(self) -> list[int]:
        """Return those that were started by one of them, as workers are by their server."""
        others = self.others()
        return [pid for pid in others if _parent(pid) in others]

    def maps(self, pid: int, library: str) -> bool:
        """Tell whether a process has loaded a library."""
        return library.encode() in _read(pid, "maps")

    def threads(self) -> int:
        """Return how many threads the first process has."""
        return len(list(Path(f"/proc/{self.pid}/task").iterdir()))

    def cpu_s(self) -> float:
        """Return the CPU time of the whole session so far, s."""
        return (self._reaped_s or 0.0) + sum(map(_cpu_s, _alive(self.pid)))

    def said(self) -> str:
        """Return what was printed to either output."""
        return self._text(self._out) + self._text(self._error)

    def send(self, number: signal.Signals, *, group: bool = True) -> float:
        """Send a signal, to everything as a terminal does, or to the first process only.

        Return the CPU time of the session at that moment, s: everything is stopped meanwhile.
        """
        os.killpg(self.pid, signal.SIGSTOP)
        until_then_s = self.cpu_s()
        (os.killpg if group else os.kill)(self.pid, number)
        os.killpg(self.pid, signal.SIGCONT)
        return until_then_s

    def end(self) -> Ended:
        """Wait until nothing is left."""
        self.until(lambda session: False, "the end")
        _, status, usage = os.wait4(self.pid, 0)
        self._process.returncode = os.waitstatus_to_exitcode(status)
        self._reaped_s = total_s = usage.ru_utime + usage.ru_stime
        deadline = time.monotonic() + PATIENCE_S
        while _alive(self.pid):  # what was killed may still have to be scheduled to die
            assert time.monotonic() < deadline, f"{len(_alive(self.pid))} processes are left"
            total_s = max(total_s, self.cpu_s())
            time.sleep(0.01)
        code = self._process.returncode
        return Ended(code, self._text(self._out), self._text(self._error), total_s)

    def close(self) -> None:
        """End whatever is left."""
        for pid in _alive(self.pid):
            os.kill(pid, signal.SIGKILL)
        self._process.wait()
        self._out.close()
        self._error.close()

    @staticmethod
    def _text(file) -> str:
        file.seek(0)
        return file.read()


def _read(pid: int, name: str) -> bytes:
    try:
        return Path(f"/proc/{pid}/{name}").read_bytes()
    except OSError:
        return b""


def _status(pid: int) -> list[bytes]:
    """Return the fields of /proc/PID/stat from the state on."""
    return _read(pid, "stat").rpartition(b")")[2].split()


def _parent(pid: int) -> int:
    fields = _status(pid)
    return int(fields[1]) if fields else 0


def _alive(session: int) -> list[int]:
    """Return the processes of a session that are no zombies."""
    found = []
    names = (each.name for each in Path("/proc").iterdir())
    for pid in map(int, filter(str.isdigit, names)):
        with suppress(OSError):  # it has ended meanwhile
            # To ask for the session costs a thousandth of reading a file of /proc.
            if os.getsid(pid) == session and _status(pid)[:1] not in ([], [b"Z"]):
                found.append(pid)
    return found


def _cpu_s(pid: int) -> float:
    """Return the CPU time of a process and of the children that it has waited for."""
    return TICK_S * sum(map(int, _status(pid)[11:15]))
