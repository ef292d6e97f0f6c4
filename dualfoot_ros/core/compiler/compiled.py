"""The kernel compiled by numba, from the same function objects that run interpreted."""

from __future__ import annotations

import types
from functools import cache
from pathlib import Path
from typing import Any

from ..kernel import ENTRIES, MODULES, Engine, kernel_functions
from .adapters import Entry
from .cache import READY, usable_cache
from .numba_cache import keep_in
from .shared_library import can_link, library_path, load_library, write_library


@cache
def compiled() -> Engine:
    """Return the kernel compiled by numba, from the cache where it is warm.

    Raises
    ------
    ImportError
        When it is not in the cache and numba is not installed.
    """
    directory = usable_cache()
    engine = None if directory is None else _from_library(directory)
    if engine is None:
        engine = _from_numba(directory)
    if directory is not None:
        (directory / READY).touch()
    return engine


def _from_library(directory: Path) -> Engine | None:
    """Return the kernel as a library in ``directory``, made where it is not there.

    None where it cannot be linked, which an empty file in its place tells the next process.
    """
    path = library_path(directory)
    try:
        if not path.exists() and can_link() and not write_library(path, _machine_code()):
            path.touch()
    except OSError:  # a full disk, a folder that has gone
        return None
    functions = load_library(path)
    return None if functions is None else Engine("compiled", **functions)


def _machine_code() -> dict[Entry, Any]:
    """Return what numba makes of each entry, without the means to call it from Python."""
    built = _dispatchers(None, no_cpython_wrapper=True, no_cfunc_wrapper=True)
    code = {}
    for name, signature in _signatures().items():
        built[name].compile(signature)
        code[_entry(name, signature)] = built[name].overloads[signature.args]
    return code


def _entry(name: str, signature: Any) -> Entry:
    """Return the description of an entry with the types of numba."""
    from numba import boolean, float64, int64, types

    letters = {int64: "i", boolean: "b", float64: "d", types.none: "n"}
    arguments = (letters.get(each) or "?vm"[each.ndim] for each in signature.args)
    return Entry(name, letters[signature.return_type], "".join(arguments))


def _from_numba(directory: Path | None) -> Engine:
    """Return the kernel as numba loads it."""
    built = _dispatchers(directory)
    for name, signature in _signatures().items():
        built[name].compile(signature)
        built[name].disable_compile()
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


def _dispatchers(directory: Path | None, **options: bool) -> dict[str, Any]:
    """Copy every kernel function with the compiled ones in its globals, and wrap it.

    ``options`` are those of numba; ``directory`` is where it keeps the entries.
    """
    from numba import njit

    built: dict[str, Any] = {}
    namespaces = {module.__name__: dict(vars(module)) for module in MODULES}
    for name, function in kernel_functions().items():
        namespace = namespaces[function.__module__]
        copy = types.FunctionType(function.__code__, namespace, name, function.__defaults__)
        copy.__module__, copy.__qualname__ = function.__module__, function.__qualname__
        built[name] = njit(**options)(copy)
        if name in ENTRIES and directory is not None:
            keep_in(built[name], directory)
    for namespace in namespaces.values():
        namespace.update({name: item for name, item in built.items() if name in namespace})
    return built
