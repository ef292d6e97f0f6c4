"""Libraries of functions like those of the kernel: made once, and kept in the cache."""

from __future__ import annotations

import hashlib
import types
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path

from .cache import loaded_code, usable_cache
from .entries import Entry
from .shared_library import Functions, library_path, load_library


def compiled_module(
    module: types.ModuleType,
    entries: Mapping[str, Entry],
    is_good: Callable[[Functions], bool],
) -> Functions | None:
    """Return the compiled ``entries`` of a module that is written like the kernel.

    None where there is no C compiler, or nothing that it makes is good.
    """
    functions = {n: f for n, f in vars(module).items() if isinstance(f, types.FunctionType)}
    key = hashlib.sha256(loaded_code(functions, [module])).hexdigest()[:16]
    name = f"{module.__name__.rpartition('.')[2]}-{key}"
    return kept_library(usable_cache(), name, functions, entries, is_good)


def kept_library(
    directory: Path | None,
    name: str,
    functions: Mapping[str, types.FunctionType],
    entries: Mapping[str, Entry],
    is_good: Callable[[Functions], bool],
) -> Functions | None:
    """Return the ``entries`` of a library that is kept in ``directory`` where that can be.

    Once it is loaded no file is needed: where it cannot be kept, it is made for this process.
    """

    def of(folder: Path) -> Functions | None:
        """Return them from a folder; an empty file tells the next process that none was good."""
        path = library_path(folder, name)
        if path.exists():
            return load_library(path, entries)
        from .c_library import library_source  # here: a warm cache needs none of them
        from .made_library import can_compile, make_library

        if not can_compile():
            return None
        made = make_library(path, library_source(functions, entries), entries, is_good)
        if made is None:
            path.touch()
        return made

    if directory is not None:
        with suppress(OSError):  # a full disk, a folder that has gone
            return of(directory)
    from tempfile import TemporaryDirectory

    with suppress(OSError), TemporaryDirectory() as folder:
        return of(Path(folder))
    return None
