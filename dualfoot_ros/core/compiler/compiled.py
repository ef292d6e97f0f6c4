"""The kernel compiled by numba, from the same function objects that run interpreted."""

from __future__ import annotations

import types
from functools import cache
from pathlib import Path
from typing import Any

from ..kernel import ENTRIES, MODULES, Engine, kernel_functions
from .cache import READY, usable_cache
from .numba_cache import keep_in


@cache
def compiled() -> Engine:
    """Return the kernel compiled by numba, from the cache where it is warm.

    Raises
    ------
    ImportError
        When numba is not installed.
    """
    directory = usable_cache()
    built = _dispatchers(directory)
    for name, signature in _signatures().items():
        built[name].compile(signature)
        built[name].disable_compile()
    if directory is not None:
        (directory / READY).touch()
    return Engine("compiled", **{name: built[name] for name in ENTRIES})


def _signatures() -> dict[str, Any]:
    """Return the types of the arguments of every entry."""
    from numba import boolean, float64, int64, void

    w, n = float64[::1], int64[::1]
    rows = float64[:, ::1]
    return {
        "advance": int64(w, n, w, rows, int64, int64, rows),
        "rerun": void(w, n, int64, int64),
        "restore": void(w, n, int64),
        "set_flags": void(n, int64, int64, int64, boolean),
        "emit": void(w, n, rows, int64),
        "collect": void(w, int64),
        "correct": float64(w, int64),
        "correct_considering": float64(w, int64, int64),
        "turn": void(w, int64, int64, float64, float64, w, w),
        "closest": void(w, float64, float64),
    }


def _dispatchers(directory: Path | None) -> dict[str, Any]:
    """Copy every kernel function with the compiled ones in its globals, and wrap it."""
    from numba import njit

    built: dict[str, Any] = {}
    namespaces = {module.__name__: dict(vars(module)) for module in MODULES}
    for name, function in kernel_functions().items():
        namespace = namespaces[function.__module__]
        copy = types.FunctionType(function.__code__, namespace, name, function.__defaults__)
        copy.__module__, copy.__qualname__ = function.__module__, function.__qualname__
        built[name] = njit(copy)
        if name in ENTRIES and directory is not None:
            keep_in(built[name], directory)
    for namespace in namespaces.values():
        namespace.update({name: item for name, item in built.items() if name in namespace})
    return built
