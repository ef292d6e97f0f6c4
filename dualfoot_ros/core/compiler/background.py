"""Getting the compiled kernel ready while the caller goes on with the interpreted one."""

from __future__ import annotations

import importlib.util
import sys
import threading

from ..kernel import Engine
from .cache import READY, usable_cache
from .compiled import compiled

COMMAND = (sys.executable, "-m", __package__)


class BackgroundEngine:
    """Gets the compiled kernel ready.

    A cold cache is filled by another process, so that the translation never competes with the live
    path for the interpreter.  Loading from a warm cache takes some ms, or half a second where
    numba has to do it.
    """

    def __init__(self) -> None:
        """Start at once."""
        self._ready: Engine | None = None
        self._thread = threading.Thread(target=self._prepare, name="kernel", daemon=True)
        self._thread.start()

    def poll(self) -> Engine | None:
        """Return the compiled kernel when it is ready, else None."""
        return self._ready

    def wait(self) -> Engine | None:
        """Wait until the compiled kernel is ready; None when nothing here can make it."""
        self._thread.join()
        return self._ready

    def _prepare(self) -> None:
        try:
            directory = usable_cache()
            if directory is not None and not (directory / READY).exists():
                _fill_cache()
            self._ready = compiled()
        except (ImportError, OSError):
            self._ready = None


def _fill_cache() -> None:
    """Have another process fill the cache where something here can compile."""
    import subprocess  # here: a warm cache needs no process

    from .made_library import can_compile

    if can_compile() or importlib.util.find_spec("numba") is not None:
        # A session of its own: Ctrl-C ends the caller only, and the cache is filled.
        subprocess.run(COMMAND, check=False, stdout=subprocess.DEVNULL, start_new_session=True)
