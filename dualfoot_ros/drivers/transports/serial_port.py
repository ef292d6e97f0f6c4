"""Serial ports, USB ones included, read by pyserial."""

from __future__ import annotations

import contextlib
import os
from dataclasses import dataclass
from importlib import util
from typing import Any

from ...core import Parameters, SourceError, parameter
from .transport import POLL_S, Transport


@dataclass(frozen=True)
class SerialConfig(Parameters):
    """Options of a serial port."""

    baud: int = parameter(115200, "bits a second", unit="1/s", minimum=300, maximum=12_000_000)
    silence: float = parameter(
        0.0,
        "open the port again after so long without a byte; 0 never, as opening resets many boards",
        unit="s",
        minimum=0.0,
        maximum=3600.0,
    )


class SerialTransport(Transport):
    """A serial port; no other process can open it meanwhile."""

    def __init__(self, path: str, config: SerialConfig | None = None) -> None:
        """Name the port, as in ``/dev/ttyUSB0`` or ``COM3``; nothing is opened yet.

        Raises
        ------
        SourceError
            When pyserial is not installed.
        """
        if util.find_spec("serial") is None:
            raise SourceError(
                "a serial:// source needs the package pyserial: pip install pyserial"
            )
        super().__init__(path)
        config = config or SerialConfig()
        self.silence_s = config.silence
        self._baud = config.baud
        self._port: Any = None

    def open(self) -> None:
        """Open the port; raise :class:`OSError` when it is absent, busy or forbidden."""
        import serial

        with _as_os_error(self.description):
            self._port = serial.Serial(
                self.description, self._baud, timeout=POLL_S, exclusive=True
            )
        with contextlib.suppress(OSError, ValueError, NotImplementedError):
            self._port.set_low_latency_mode(True)  # USB adapters hold bytes back for 16 ms

    def read(self) -> bytes:
        """Return what has come; raise :class:`OSError` when the device is gone."""
        with _as_os_error(self.description):
            return bytes(self._port.read(max(1, self._port.in_waiting)))

    def close(self) -> None:
        """Close the port."""
        port, self._port = self._port, None
        if port is not None:
            with contextlib.suppress(Exception):  # a device that is gone cannot be closed well
                port.close()


@contextlib.contextmanager
def _as_os_error(port: str) -> Any:
    """Turn the other exceptions of pyserial and the terminal layer into OSError."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        text = os.strerror(error.errno)  # pyserial says it twice
        raise OSError(error.errno, text, port) from error
    except Exception as error:
        raise OSError(f"{type(error).__name__}: {error}") from error
