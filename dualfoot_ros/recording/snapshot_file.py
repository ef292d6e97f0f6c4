"""Snapshots of a running tracker as files."""

from __future__ import annotations

from pathlib import Path

from ..core import DualFootTracker
from .atomic import write_bytes


def write_snapshot(tracker: DualFootTracker, path: str | Path) -> None:
    """Write what the ``tracker`` is to ``path`` in one step; an existing file is replaced.

    Raises
    ------
    RecordingError
        When ``path`` exists and is no ordinary file.
    OSError
        When it cannot be written; names ``path``.
    """
    write_bytes(Path(path), tracker.save())


def read_snapshot(path: str | Path, *, engine: str = "auto") -> DualFootTracker:
    """Return the tracker of a snapshot at ``path``; it goes on as that one would have.

    Raises
    ------
    SnapshotError
        When the file is damaged, of another version, or no snapshot.
    OSError
        When it cannot be read.
    """
    return DualFootTracker.load(Path(path).read_bytes(), engine=engine)
