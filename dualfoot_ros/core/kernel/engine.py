"""The kernel in its two forms: interpreted Python, and the same source compiled by numba.

Nothing is compiled at import.  ``interpreted()`` is always there; ``compiled()`` loads the
compiled form from the cache or makes it.  The cache is keyed by the text of the kernel's own
modules, because numba looks at the file of the outermost function only and would otherwise keep
stale code when an inner module changes.
"""

from __future__ import annotations

import hashlib
import importlib
import inspect
import os
import subprocess
import sys
import tempfile
import threading
import types
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from . import covariance, detector, epoch, layout, strapdown, turn
from . import measurement_update as update

MODULES = (strapdown, covariance, update, detector, epoch, turn)
ENTRIES = ("advance", "rerun", "restore", "set_flags", "emit", "collect", "correct", "turn")


@dataclass(frozen=True)
class Engine:
    """The kernel's entry points in one of the two forms."""

    name: str
    advance: Callable[..., Any]
    rerun: Callable[..., Any]
    restore: Callable[..., Any]
    set_flags: Callable[..., Any]
    emit: Callable[..., Any]
    collect: Callable[..., Any]
    correct: Callable[..., Any]
    turn: Callable[..., Any]


def _functions() -> dict[str, types.FunctionType]:
    found = {}
    for module in MODULES:
        for name, item in vars(module).items():
            if inspect.isfunction(item) and item.__module__ == module.__name__:
                found[name] = item
    return found


def interpreted() -> Engine:
    """Return the kernel as plain Python functions."""
    functions = _functions()
    return Engine("interpreted", **{name: functions[name] for name in ENTRIES})


@cache
def compiled() -> Engine:
    """Return the kernel compiled by numba, from the cache where it is warm.

    Raises
    ------
    ImportError
        When numba is not installed.
    """
    import numba
    from numba import boolean, float64, int64, void

    w, n = float64[::1], int64[::1]
    rows = float64[:, ::1]
    signatures = {
        "advance": int64(w, n, w, rows, int64, int64, rows),
        "rerun": void(w, n, int64, int64),
        "restore": void(w, n, int64),
        "set_flags": void(n, int64, int64, int64, boolean),
        "emit": void(w, n, rows, int64),
        "collect": void(w, int64),
        "correct": float64(w, int64),
        "turn": void(w, int64, int64, float64, float64, w, w),
    }
    directory = _usable_cache()
    settings: Any = numba.config
    before = settings.CACHE_DIR
    settings.CACHE_DIR = before if directory is None else str(directory)
    try:
        built = _dispatchers(numba.njit, directory is not None)
        for name, signature in signatures.items():
            built[name].compile(signature)
            built[name].disable_compile()
    finally:
        settings.CACHE_DIR = before
    if directory is not None:
        (directory / "ready").touch()
    return Engine("compiled", **{name: built[name] for name in ENTRIES})


def _dispatchers(njit: Callable[..., Any], keep: bool) -> dict[str, Any]:
    """Copy every kernel function with the compiled ones in its globals, and wrap it."""
    built: dict[str, Any] = {}
    namespaces = {module.__name__: dict(vars(module)) for module in MODULES}
    for name, function in _functions().items():
        namespace = namespaces[function.__module__]
        copy = types.FunctionType(function.__code__, namespace, name, function.__defaults__)
        copy.__module__, copy.__qualname__ = function.__module__, function.__qualname__
        built[name] = njit(cache=keep)(copy) if name in ENTRIES else njit(copy)
    for namespace in namespaces.values():
        namespace.update({name: item for name, item in built.items() if name in namespace})
    return built


def cache_directory() -> Path:
    """Return the directory of the compiled kernel, made if it is not there.

    ``DUALFOOT_CACHE_DIR`` overrides the user's cache directory.
    """
    text = f"{_loaded_code()} {sys.version} {_numba_version()}"
    key = hashlib.sha256(text.encode()).hexdigest()[:16]
    home = os.environ.get("XDG_CACHE_HOME") or str(Path("~/.cache").expanduser())
    base = Path(os.environ.get("DUALFOOT_CACHE_DIR") or Path(home) / "dualfoot_ros")
    directory = base / f"kernel-{key}"
    directory.mkdir(parents=True, exist_ok=True)
    return directory


def _loaded_code() -> str:
    """Return all that the compiled form depends on, as it was loaded (files may have changed)."""
    codes = [
        (name, f.__code__.co_code.hex(), f.__code__.co_consts, f.__code__.co_names)
        for name, f in sorted(_functions().items())
    ]
    offsets = sorted((k, v) for k, v in vars(layout).items() if isinstance(v, int))
    return repr((codes, offsets))


def _numba_version() -> str:
    try:
        return metadata.version("numba")
    except metadata.PackageNotFoundError:
        return "none"


def _usable_cache() -> Path | None:
    """Return the cache directory; None where nothing can be written, and nothing is kept then."""
    try:
        directory = cache_directory()
        with tempfile.TemporaryFile(dir=directory):
            return directory
    except OSError:
        return None


class BackgroundEngine:
    """Gets the compiled kernel ready while the caller goes on with the interpreted one.

    A cold cache is filled by another process, so that the compiler never competes with the live
    path for the interpreter; loading from a warm cache takes about a second in a thread.
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
        """Wait until the compiled kernel is ready; None when there is none (no numba)."""
        self._thread.join()
        return self._ready

    def _prepare(self) -> None:
        try:
            importlib.import_module("numba")
            directory = _usable_cache()
            if directory is not None and not (directory / "ready").exists():
                command = [sys.executable, "-m", "dualfoot_ros.core.kernel"]
                # A session of its own: Ctrl-C ends the caller only, and the cache is filled.
                subprocess.run(
                    command, check=False, stdout=subprocess.DEVNULL, start_new_session=True
                )
            self._ready = compiled()
        except (ImportError, OSError):
            self._ready = None
