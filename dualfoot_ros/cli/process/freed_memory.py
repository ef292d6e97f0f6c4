"""Memory that a short program frees is kept for its next arrays.

The allocator of glibc gives arrays of some hundred kilobytes back to the system as they go, and
gets pages of zeros for the next ones: a twentieth of the time of a short command.
"""

from __future__ import annotations

import ctypes
from contextlib import suppress

M_TRIM_THRESHOLD, M_TOP_PAD, M_MMAP_THRESHOLD = -1, -2, -3  # as in malloc.h
OPTIONS = {
    M_MMAP_THRESHOLD: 1 << 25,  # bytes: a smaller array is taken from what is kept
    M_TRIM_THRESHOLD: 1 << 27,  # how much is kept
    M_TOP_PAD: 1 << 24,  # by how much it grows at a time
}


def keep_freed_memory() -> None:
    """Tell the allocator so, where it is that of glibc."""
    with suppress(OSError, AttributeError, TypeError):  # another library, another system
        mallopt = ctypes.CDLL(None).mallopt
        for option, size in OPTIONS.items():
            mallopt(option, size)
