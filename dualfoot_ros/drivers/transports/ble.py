"""Sensors over Bluetooth Low Energy, read by bleak, which is an optional extra.

Xsens (Movella) DOT, after the Movella DOT BLE Service Specification (XD0506P), section 3:
notifications of the measurement characteristic, started and stopped by three bytes to the control
characteristic.  WitMotion, after the maker's protocol pages: notifications of one characteristic,
which come by themselves.
"""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from importlib import util
from typing import TYPE_CHECKING, Any, NamedTuple

from ...core import Parameters, SourceError, parameter
from ..protocols.dot import PAYLOADS, DotConfig
from .transport import POLL_S, Transport

if TYPE_CHECKING:
    import asyncio

UUID = "1517{:04x}-4947-11e9-8646-d663bd873d93"
CONTROL = 0x2001
MEASUREMENT, START, STOP = 1, 1, 0
FAREWELL_S = 2.0
WITMOTION = "0000ffe4-0000-1000-8000-00805f9a34fb"
HEX = "[0-9A-Fa-f]"
ADDRESS = re.compile(rf"({HEX}{{2}}:){{5}}{HEX}{{2}}|{HEX}{{8}}(-{HEX}{{4}}){{3}}-{HEX}{{12}}")


@dataclass(frozen=True)
class BleConfig(Parameters):
    """Options of a Bluetooth source."""

    connect: float = parameter(
        10.0, "give a try to connect up after so long", unit="s", minimum=1.0, maximum=60.0
    )
    silence: float = parameter(
        5.0,
        "connect again after so long without a notification; 0 never",
        unit="s",
        minimum=0.0,
        maximum=3600.0,
    )


class Profile(NamedTuple):
    """How a device sends: its characteristic, and the mode that starts it (None: by itself)."""

    characteristic: str
    mode: int | None = None


def profile_of(decoder: Parameters) -> Profile:
    """Return the profile of the devices that the decoder of these options is for."""
    if isinstance(decoder, DotConfig):
        payload = PAYLOADS[decoder.payload]
        return Profile(UUID.format(payload.characteristic), payload.mode)
    return Profile(WITMOTION)


class BleTransport(Transport):
    """Notifications of a measuring device, one a call."""

    def __init__(
        self, address: str, config: BleConfig | None = None, decoder: Parameters | None = None
    ) -> None:
        """Name the device (``D4:22:CD:00:12:34``); nothing is opened yet.

        ``decoder`` has the options of the decoder of its format (default: a DOT).

        Raises
        ------
        SourceError
            When the address is not one of Bluetooth, or bleak is not installed.
        """
        if ADDRESS.fullmatch(address) is None:
            raise SourceError(
                f"the Bluetooth address is '{address}'; allowed is as in D4:22:CD:00:12:34 "
                "(on macOS the UUID that the system gives the device)"
            )
        if util.find_spec("bleak") is None:
            raise SourceError("a ble:// source needs bleak: pip install 'dualfoot_ros[ble]'")
        super().__init__(f"BLE {address}")
        config = config or BleConfig()
        self.silence_s = config.silence
        self._address = address
        self._connect_s = config.connect
        self._profile = profile_of(decoder or DotConfig())
        self._loop: asyncio.AbstractEventLoop | None = None
        self._client: Any = None

    def open(self) -> None:
        """Connect and start the measurement; raise :class:`OSError` when that fails."""
        import asyncio  # here, as it takes a while, and few have such a sensor

        self._loop = asyncio.new_event_loop()
        self._queue: asyncio.Queue[bytes | None] = asyncio.Queue()
        try:
            self._loop.run_until_complete(self._start())
        except OSError:
            raise
        except Exception as error:  # bleak has errors of its own for each system
            raise OSError(f"{type(error).__name__}: {error}") from error

    def read(self) -> bytes:
        """Return one notification; raise :class:`OSError` when the device has disconnected."""
        import asyncio

        assert self._loop is not None
        try:
            data = self._loop.run_until_complete(asyncio.wait_for(self._queue.get(), POLL_S))
        except TimeoutError:
            return b""
        if data is None:
            raise ConnectionResetError("the device has disconnected")
        return data

    def close(self) -> None:
        """Stop the measurement as far as that is possible, and disconnect."""
        import asyncio

        loop, self._loop = self._loop, None
        if loop is None:
            return
        with contextlib.suppress(Exception):
            loop.run_until_complete(asyncio.wait_for(self._finish(), FAREWELL_S))
        self._client = None
        loop.close()

    async def _start(self) -> None:
        import asyncio

        from bleak import BleakClient

        self._client = BleakClient(self._address, disconnected_callback=self._gone)
        await asyncio.wait_for(self._client.connect(), self._connect_s)
        await self._client.start_notify(self._profile.characteristic, self._notified)
        await self._command(START)

    async def _finish(self) -> None:
        if self._client is not None and self._client.is_connected:
            with contextlib.suppress(Exception):
                await self._command(STOP)
        if self._client is not None:
            await self._client.disconnect()

    async def _command(self, action: int) -> None:
        if self._profile.mode is None:
            return
        message = bytes([MEASUREMENT, action, self._profile.mode])
        await self._client.write_gatt_char(UUID.format(CONTROL), message, response=True)

    def _notified(self, _sender: object, data: bytearray) -> None:
        self._queue.put_nowait(bytes(data))

    def _gone(self, _client: object) -> None:
        self._queue.put_nowait(None)
