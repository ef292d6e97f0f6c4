"""Large arrays in files without a name, of which little is in memory at a time.

A file is gone with the array, however the program ends.  What is resident of all of them is let go
of again and again by a thread; it stays in the file (and in the cache of the system, as far as
there is room), and comes back where it is looked at.
"""

from __future__ import annotations

import io
import math
import mmap
import os
import threading
import time
import weakref
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...core import RecordingError, make_large_arrays_in, os_error_text

ROOMY = Path("/var/tmp")  # noqa: S108 - files have no name there; /tmp is often in memory itself
MOST_RESIDENT = 1 << 26  # bytes of the files in memory, before they are let go of
EVERY_S = 0.02
STATM = "/proc/self/statm"
MEGABYTE = 1_000_000


def keep_large_arrays_on_disk() -> None:
    """Make the large arrays of this program in files from now on."""
    make_large_arrays_in(FILES)


def room() -> Path:
    """Return the folder of the files: that of TMPDIR, else one that is on disk."""
    import tempfile  # here, as below: most walks are short, and it takes as long as reading one

    if os.environ.get("TMPDIR") or not os.access(ROOMY, os.W_OK):
        return Path(tempfile.gettempdir())
    return ROOMY


def _no_room(folder: Path, size: int, error: OSError) -> str:
    import shutil

    free = shutil.disk_usage(folder).free
    return (
        f"an array of this long walk needs {size / MEGABYTE:.0f} MB in {folder}, where "
        f"{free / MEGABYTE:.0f} MB are free ({os_error_text(error)}); make room there, or name "
        "another folder by the environment variable TMPDIR"
    )


class Files:
    """The files of a program, and what of them is resident.

    It is let go of between blocks of rows, and by a thread, for all that does not work by block.
    """

    def __init__(self) -> None:
        self._files: weakref.WeakSet[mmap.mmap] = weakref.WeakSet()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._least = 0

    def new(self, shape: tuple[int, ...], dtype: np.dtype[Any]) -> NDArray[Any]:
        """Return an array of zeros in a file of its own.

        Raises
        ------
        RecordingError
            When there is no room for it on disk; names the folder and what was needed.
        """
        import tempfile

        size = math.prod(shape) * dtype.itemsize
        folder = room()
        try:
            with tempfile.TemporaryFile(dir=folder, buffering=0) as file:
                os.posix_fallocate(file.fileno(), 0, size)  # else writing would end the program
                pages = mmap.mmap(file.fileno(), size)
        except OSError as error:
            raise RecordingError(_no_room(folder, size, error)) from error
        _take_large_pages(pages)
        self._watch(pages)
        return np.frombuffer(pages, dtype=dtype).reshape(shape)

    def rest(self) -> None:
        """Let go of what is resident where that is more than a little."""
        resident = _of_files()
        if resident - self._least > MOST_RESIDENT:
            self.let_go()
            self._least = _of_files()
        elif resident < self._least:
            self._least = resident

    def let_go(self) -> None:
        """Leave the pages of all files to the system; what is in them stays."""
        with self._lock:
            files = list(self._files)
        for pages in files:
            pages.madvise(mmap.MADV_DONTNEED)

    def _watch(self, pages: mmap.mmap) -> None:
        with self._lock:
            self._files.add(pages)
            if not (self._thread and self._thread.is_alive()):
                self._least = _of_files()
                self._thread = threading.Thread(target=self._keep_few, daemon=True)
                self._thread.start()

    def _keep_few(self) -> None:
        while not self._is_done():
            time.sleep(EVERY_S)
            self.rest()

    def _is_done(self) -> bool:
        """Return whether there are no files; then the thread ends, and another one may begin."""
        with self._lock:
            if not self._files:
                self._thread = None
            return self._thread is None


def _take_large_pages(pages: mmap.mmap) -> None:
    """Ask the system for pages of megabytes: with small ones, writing takes five times as long."""
    if hasattr(mmap, "MADV_HUGEPAGE"):
        with suppress(OSError):  # it has none
            pages.madvise(mmap.MADV_HUGEPAGE)


def _of_files() -> int:
    """Return how many bytes of files are resident, those of libraries too; 0 where none can tell.

    The system tells it in pages: all, resident, those of files.
    """
    try:
        with io.FileIO(STATM) as told:
            return int(told.read().split()[2]) * mmap.PAGESIZE
    except OSError:
        return 0


FILES = Files()
