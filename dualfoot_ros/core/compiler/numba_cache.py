"""A cache of compiled functions in a directory of our own, without touching numba's settings.

numba takes the directory of its caches from a setting of the whole process.  Changing that, even
for a moment, would send functions that the user's own code compiles meanwhile to our directory.
So each of our dispatchers gets a cache object of its own.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any


def keep_in(dispatcher: Any, directory: Path) -> None:
    """Have ``dispatcher`` load its machine code from ``directory``, and save it there."""
    from numba.core.caching import CompileResultCacheImpl, FunctionCache

    class Locator:
        """Tells numba where the code of one function is kept."""

        def __init__(self, function: Any) -> None:
            self._name: str = function.__qualname__

        @classmethod
        def from_function(cls, function: Any, _file: str) -> Locator:
            return cls(function)

        def ensure_cache_path(self) -> None:
            directory.mkdir(parents=True, exist_ok=True)

        def get_cache_path(self) -> str:
            return str(directory)

        def get_source_stamp(self) -> str:
            return directory.name  # which names the code

        def get_disambiguator(self) -> str:
            return self._name

    class Implementation(CompileResultCacheImpl):
        """numba's own, but for the place."""

        _locator_classes = [Locator]  # noqa: RUF012  (numba's name)

    class Cache(FunctionCache):
        """numba's own, but for the place."""

        _impl_class = Implementation

    dispatcher._cache = Cache(dispatcher.py_func)  # noqa: SLF001  (numba has no other way)
