"""Write files and folders whole or not at all: beside the target first, then renamed."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import RecordingError


def write_text(path: Path, text: str) -> None:
    """Write ``text`` to ``path`` in one step; an existing file is replaced."""
    path.parent.mkdir(parents=True, exist_ok=True)
    scratch = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        scratch.write_text(text, encoding="utf-8")
        scratch.replace(path)
    finally:
        scratch.unlink(missing_ok=True)


@contextmanager
def new_directory(path: Path, *, overwrite: bool = False, marker: str = "") -> Iterator[Path]:
    """Yield a path to fill beside ``path``; it becomes ``path`` when the block ends well.

    The yielded path has the final name, does not exist yet, and vanishes when the block fails.
    An existing folder is replaced only with ``overwrite``, and only when it holds ``marker``.

    Raises
    ------
    RecordingError
        When ``path`` exists and may not be replaced.
    """
    check_target(path, overwrite=overwrite, marker=marker)
    path.parent.mkdir(parents=True, exist_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".partial", dir=path.parent))
    try:
        yield scratch / path.name
        if path.exists():
            path.rename(scratch / "replaced")
        (scratch / path.name).rename(path)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def check_target(path: Path, *, overwrite: bool = False, marker: str = "") -> None:
    """Raise :class:`RecordingError` when ``path`` is there and may not be replaced."""
    if not path.exists():
        return
    if not overwrite:
        raise RecordingError(
            f"'{path}' exists already; choose another output or allow it to be overwritten"
        )
    if not path.is_dir() or (marker and not (path / marker).exists()):
        raise RecordingError(
            f"'{path}' is not something this program wrote, so it is not replaced; "
            "choose another output"
        )
