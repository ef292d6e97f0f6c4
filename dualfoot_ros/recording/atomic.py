"""Files and folders written whole or not at all: beside the target first, then renamed."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ..core import RecordingError

OF_THE_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)  # not of one file


def write_text(path: Path, text: str) -> None:
    """Write ``text`` to ``path`` in one step; an existing file is replaced.

    Raises
    ------
    RecordingError
        When ``path`` exists and is no ordinary file (a folder, a device).
    OSError
        When it cannot be written; names ``path``.
    """
    write_bytes(path, text.encode())


def write_bytes(path: Path, data: bytes) -> None:
    """Write ``data`` to ``path`` in one step; an existing file is replaced.

    Raises
    ------
    RecordingError
        When ``path`` exists and is no ordinary file (a folder, a device).
    OSError
        When it cannot be written; names ``path``.
    """
    with new_file(path) as written:
        written.write_bytes(data)


@contextmanager
def new_file(path: Path) -> Iterator[Path]:
    """Yield a path to write beside ``path``; it replaces ``path`` when the block ends well.

    Raises
    ------
    RecordingError
        When ``path`` exists and is no ordinary file (a folder, a device).
    OSError
        When it cannot be written; names ``path``.
    """
    check_file(path, overwrite=True)
    with _scratch_folder(path) as scratch:
        yield scratch / path.name
        with _naming(path):
            (scratch / path.name).replace(path)


def check_file(path: Path, *, overwrite: bool = False) -> None:
    """Raise :class:`RecordingError` when ``path`` is there and no file, or not to be replaced."""
    if not os.path.lexists(path):
        return
    if not path.is_file():
        raise RecordingError(
            f"'{path}' is there and is no ordinary file, so it is not replaced; choose another "
            "output"
        )
    if not overwrite:
        raise RecordingError(f"'{path}' exists already; choose another output or give --overwrite")


@contextmanager
def new_directory(path: Path, *, overwrite: bool = False, marker: str = "") -> Iterator[Path]:
    """Yield a path to fill beside ``path``; it becomes ``path`` when the block ends well.

    The yielded path has the final name, does not exist yet, and vanishes when the block fails.
    An existing folder is replaced only with ``overwrite``, and only when it holds ``marker``.

    Raises
    ------
    RecordingError
        When ``path`` exists and may not be replaced.
    OSError
        When no folder can be made there, or the disk is full; names ``path``.
    """
    check_target(path, overwrite=overwrite, marker=marker)
    with _scratch_folder(path) as scratch:
        yield scratch / path.name
        replaced = scratch / "replaced"
        try:
            if path.exists():
                path.rename(replaced)
            (scratch / path.name).rename(path)
        finally:
            if replaced.exists() and not path.exists():
                replaced.rename(path)


@contextmanager
def new_files(directory: Path, *, replacing: Sequence[str] = ()) -> Iterator[Path]:
    """Yield an empty folder to fill; its files go to ``directory`` when the block ends well.

    ``directory`` is made, or kept with what it holds; of its files only those are removed that
    match a pattern of ``replacing``.

    Raises
    ------
    OSError
        When no folder can be made there, or the disk is full; names ``directory``.
    """
    with _scratch_folder(directory) as scratch:
        yield scratch
        directory.mkdir(exist_ok=True)
        for stale in (path for pattern in replacing for path in directory.glob(pattern)):
            shutil.rmtree(stale) if stale.is_dir() else stale.unlink()
        for path in scratch.iterdir():
            path.replace(directory / path.name)


def check_target(path: Path, *, overwrite: bool = False, marker: str = "") -> None:
    """Raise :class:`RecordingError` when ``path`` is there and may not be replaced."""
    if not path.exists():
        return
    if not overwrite:
        raise RecordingError(
            f"'{path}' exists already; choose another output or let it be replaced (--overwrite)"
        )
    if not path.is_dir() or (marker and not (path / marker).exists()):
        raise RecordingError(
            f"'{path}' is not something this program wrote, so it is not replaced; "
            "choose another output"
        )


@contextmanager
def _scratch_folder(path: Path) -> Iterator[Path]:
    """Yield an empty folder on the file system of ``path``, removed when the block ends."""
    with _naming(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        made = tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".partial", dir=path.parent)
    try:
        yield Path(made)
    except OSError as error:
        if error.errno in OF_THE_DISK and str(error.filename or made).startswith(made):
            raise _unwritable(path, error) from None
        raise
    finally:
        _remove(made)


def _remove(folder: str) -> None:
    """Remove a folder, also when Ctrl-C comes in the midst of it."""
    try:
        shutil.rmtree(folder, ignore_errors=True)
    except KeyboardInterrupt:
        shutil.rmtree(folder, ignore_errors=True)
        raise


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Let an OSError name ``path``, as it was given, and no scratch file."""
    try:
        yield
    except OSError as error:
        raise _unwritable(path, error) from None


def _unwritable(path: Path, error: OSError) -> OSError:
    above = next((p for p in path.parents if os.path.lexists(p)), path.parent)
    reason = error.strerror if above.is_dir() else f"'{above}' is no folder"
    return OSError(error.errno, f"it cannot be written: {reason}", str(path))
