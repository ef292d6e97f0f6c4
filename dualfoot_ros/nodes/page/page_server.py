"""Server of the live page: one page, its state, and Server-Sent Events.  It only answers GET."""

from __future__ import annotations

import errno
import ipaddress
import json
import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from ...core import ConfigError
from .live_state import Cursor, LiveState

PERIOD_S = 0.2  # between two messages to a browser
POLL_S = 0.1  # between two looks whether the server has to end
PATIENCE_S = 10.0  # for a browser that does not read, or does not finish its question
MOST_READERS = 16
RETRY_MS = 1000
LOCAL = "localhost"
ONLY_GET = "the page can only be read: GET"
STRANGER = (
    "this server answers only to its address, not to the name '{}': open the address that "
    "'dualfoot live' printed"
)
FULL = f"{MOST_READERS} browsers show this page already; close one of them"
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class PageServer(ThreadingHTTPServer):
    """Server of one page on ``host`` and ``port`` (0: any free one), in threads of its own.

    Raises
    ------
    ConfigError
        When it cannot be served there; says what to do.
    """

    daemon_threads = True
    block_on_close = False

    def __init__(self, host: str, port: int, state: LiveState, page: str) -> None:
        self.state, self.page, self.host = state, page, host
        self.ended = threading.Event()
        self.readers = threading.BoundedSemaphore(MOST_READERS)
        self.address_family = socket.AF_INET6 if ":" in host else socket.AF_INET
        try:
            super().__init__((host, port), PageHandler)
        except OSError as error:
            raise ConfigError(_sentence(error, host, port)) from None
        self._thread = threading.Thread(
            target=self.serve_forever, args=(POLL_S,), name="page", daemon=True
        )
        self._thread.start()

    @property
    def url(self) -> str:
        """Address of the page."""
        shown = f"[{self.host}]" if ":" in self.host else self.host
        return f"http://{shown}:{self.server_address[1]}/"

    def close(self) -> None:
        """End every answer, and free the port."""
        self.ended.set()
        self.shutdown()
        self.server_close()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of a browser that has gone: it comes back, or nobody misses it."""


class PageHandler(BaseHTTPRequestHandler):
    """Answer to one browser."""

    server: PageServer
    server_version, sys_version = "dualfoot", ""
    timeout = PATIENCE_S

    def parse_request(self) -> bool:
        """Refuse whatever asks by another name, or asks to change something."""
        if not super().parse_request():
            return False
        name = _name(self.headers.get("Host", ""))
        if not _is_own(name, self.server.host):
            self._refuse(HTTPStatus.MISDIRECTED_REQUEST, STRANGER.format(name))
            return False
        if self.command not in ("GET", "HEAD"):
            self._refuse(HTTPStatus.METHOD_NOT_ALLOWED, ONLY_GET)
            return False
        return True

    def do_HEAD(self) -> None:
        """Answer with the headers only."""
        self.do_GET()

    def do_GET(self) -> None:
        """Send what is asked for."""
        answers: dict[str, Callable[[], None]] = {
            "/": self._send_page,
            "/state.json": self._send_state,
            "/events": self._send_events,
        }
        answer = answers.get(self.path.partition("?")[0])
        if answer is None:
            names = ", ".join(answers)
            self._refuse(HTTPStatus.NOT_FOUND, f"there is no such page; there are {names}")
        else:
            answer()

    def _send_page(self) -> None:
        self._send(HTTPStatus.OK, "text/html", self.server.page)

    def _send_state(self) -> None:
        message, _ = self.server.state.message({})
        self._send(HTTPStatus.OK, "application/json", _to_json(message))

    def _send_events(self) -> None:
        if not self.server.readers.acquire(blocking=False):
            self._refuse(HTTPStatus.SERVICE_UNAVAILABLE, FULL)
            return
        try:
            self._begin(HTTPStatus.OK, "text/event-stream")
            self.end_headers()
            if self.command == "GET":
                self._stream()
        finally:
            self.server.readers.release()

    def _stream(self) -> None:
        cursor: Cursor = {}
        self.wfile.write(f"retry: {RETRY_MS}\n\n".encode())
        while not self.server.ended.is_set():
            message, cursor = self.server.state.message(cursor)
            self.wfile.write(f"data: {_to_json(message)}\n\n".encode())
            self.server.ended.wait(PERIOD_S)

    def _refuse(self, status: HTTPStatus, sentence: str) -> None:
        self._send(status, "text/plain", sentence + "\n")

    def _send(self, status: HTTPStatus, kind: str, text: str) -> None:
        body = text.encode()
        self._begin(status, kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def _begin(self, status: HTTPStatus, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        for name, value in HEADERS.items():
            self.send_header(name, value)

    def log_message(self, format: str, *args: Any) -> None:
        """Log no request."""


def _to_json(message: dict[str, Any]) -> str:
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def _name(host: str) -> str:
    """Return the name in a Host header, without the port."""
    name = host.strip()
    if name.startswith("["):
        return name[1:].partition("]")[0]
    return name.partition(":")[0]


def _is_own(name: str, host: str) -> bool:
    """Return whether a browser may ask by ``name``.

    A page of another site can have its own name point to this machine (DNS rebinding), but it
    cannot have an address for a name.
    """
    if name.lower() in (LOCAL, host.lower()):
        return True
    with suppress(ValueError):
        ipaddress.ip_address(name)
        return True
    return False


def _sentence(error: OSError, host: str, port: int) -> str:
    """Return why a page cannot be served, and what to do."""
    other = f"choose another with --port (parameter 'port'), as {port + 1}, or 0 for any free one"
    if error.errno == errno.EADDRINUSE:
        return f"port {port} of {host} is in use, perhaps by another live page; {other}"
    if error.errno == errno.EACCES:
        return f"port {port} of {host} may not be used by this user; choose one above 1023"
    if isinstance(error, socket.gaierror) or error.errno == errno.EADDRNOTAVAIL:
        return f"this machine has no address '{host}'; 127.0.0.1 serves this machine only"
    return f"the page cannot be served on {host}, port {port}: {error.strerror}"
