"""Where the compiled kernel is kept: a directory named by all that the machine code depends on.

The directory is keyed by the loaded code of the whole kernel and by what translates it.
"""

from __future__ import annotations

import hashlib
import os
import sys
import types
from collections.abc import Iterable, Mapping
from importlib.machinery import PathFinder
from pathlib import Path

from ..kernel import MODULES, kernel_functions

READY = "ready"  # name of the file that says that every entry is in the cache


def cache_directory() -> Path:
    """Return the directory of the compiled kernel, made if it is not there.

    ``DUALFOOT_CACHE_DIR`` overrides the user's cache directory.
    """
    code = loaded_code(kernel_functions(), MODULES)
    rest = f"{sys.version} {_numba_version()}".encode()
    key = hashlib.sha256(b" ".join([code, *_translation(), rest])).hexdigest()[:16]
    home = os.environ.get("XDG_CACHE_HOME") or str(Path("~/.cache").expanduser())
    base = Path(os.environ.get("DUALFOOT_CACHE_DIR") or Path(home) / "dualfoot_ros")
    directory = base / f"kernel-{key}"
    directory.mkdir(parents=True, exist_ok=True)
    return directory


def usable_cache() -> Path | None:
    """Return the cache directory; None where nothing can be written, and nothing is kept then."""
    try:
        directory = cache_directory()
    except OSError:
        return None
    return directory if os.access(directory, os.W_OK | os.X_OK) else None


def loaded_code(
    functions: Mapping[str, types.FunctionType], modules: Iterable[types.ModuleType]
) -> bytes:
    """Return all that the compiled form depends on, as it was loaded (files may have changed)."""
    codes = [(name, f.__code__) for name, f in sorted(functions.items())]
    named = [(name, code.co_consts, code.co_names) for name, code in codes]
    numbers = sorted(
        (module.__name__, name, value)
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, int | float)
    )
    return b" ".join([*(code.co_code for _, code in codes), repr((named, numbers)).encode()])


def _translation() -> list[bytes]:
    """Return what the translation to C depends on: the files that do it."""
    return [file.read_bytes() for file in sorted(Path(__file__).parent.glob("*.py"))]


def _numba_version() -> str:
    """Return the name of what numba was installed from, in which its version stands.

    ``importlib.metadata`` would read it from there, and takes as long to load as the kernel.
    """
    found = PathFinder.find_spec("numba")
    if found is None or found.origin is None:
        return "none"
    package = Path(found.origin).parent
    beside = sorted(each.name for each in package.parent.glob("numba-*"))
    return " ".join(beside) or f"of {package.stat().st_mtime_ns}"
