"""The compiled form of the kernel: translated to C, kept in a cache, got ready in the background.

The one part of the core that touches files, the environment, threads and processes.
"""

from .background import BackgroundEngine
from .cache import cache_directory
from .compiled import compiled
from .entries import Entry, Kind
from .kept_library import compiled_module
from .shared_library import Functions

__all__ = [
    "BackgroundEngine",
    "Entry",
    "Functions",
    "Kind",
    "cache_directory",
    "compiled",
    "compiled_module",
]
