"""The compiled kernel, from the same functions that run interpreted.

They are translated to C, which takes a tenth of the time that numba takes to compile them.  Where
there is no C compiler, or where what it made has other bits, numba does it.
"""

from __future__ import annotations

import types
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from ..kernel import ENTRIES, MODULES, Engine, kernel_functions, looked_at
from .cache import READY, usable_cache
from .entries import ENTRY_KINDS, Kind
from .kept_library import kept_library
from .numba_cache import keep_in
from .same_bits import same_bits
from .shared_library import Functions


@cache
def compiled() -> Engine:
    """Return the compiled kernel, from the cache where it is warm.

    Raises
    ------
    ImportError
        When there is neither a C compiler nor numba, and the cache is cold.
    """
    directory = usable_cache()
    functions = kept_library(directory, "kernel", kernel_functions(), ENTRY_KINDS, same_bits)
    if functions is None:
        functions = _from_numba(directory)
    if directory is not None:
        with suppress(OSError):
            (directory / READY).touch()
    return Engine("compiled", **functions)


def _from_numba(directory: Path | None) -> Functions:
    """Return the entries as numba compiles them, or loads them from ``directory``."""
    built = _dispatchers(directory)
    for name, signature in _signatures().items():
        built[name].compile(signature)
        built[name].disable_compile()
    plain: Functions = {name: built[name] for name in ENTRIES}
    return {name: looked_at(f) if name == "take_pair" else f for name, f in plain.items()}


def _signatures() -> dict[str, Any]:
    """Return the types of the arguments of every entry."""
    from numba import float64, int64, void

    kinds = {
        Kind.INTEGER: int64,
        Kind.REAL: float64,
        Kind.INTEGERS: int64[::1],
        Kind.REALS: float64[::1],
        Kind.SAMPLE: float64[::1],
        Kind.ROWS: float64[:, ::1],
    }
    return {
        name: (kinds[entry.result] if entry.result else void)(*map(kinds.get, entry.parameters))
        for name, entry in ENTRY_KINDS.items()
    }


def _dispatchers(directory: Path | None) -> dict[str, Any]:
    """Copy every kernel function with the compiled ones in its globals, and wrap it.

    ``directory`` is where numba keeps the entries.
    """
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
