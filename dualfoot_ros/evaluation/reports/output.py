"""Write the files of a report whole or not at all."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ...core import EvaluationError

METRICS = "metrics.json"
OWN = (METRICS, "*.tum", "*.png")
"""What earlier reports may have left in the folder of a report."""


def check_directory(directory: Path) -> None:
    """Raise :class:`EvaluationError` when reports cannot go to ``directory``."""
    if directory.exists() and not directory.is_dir():
        raise EvaluationError(f"output '{directory}' is a file; allowed is a folder or a new name")


@contextmanager
def staged(directory: Path) -> Iterator[Path]:
    """Yield an empty folder beside ``directory``; its files go there when the block ends well.

    An existing folder is kept; of its files those of an earlier report are replaced.
    """
    check_directory(directory)
    directory.parent.mkdir(parents=True, exist_ok=True)
    prefix = f".{directory.name}."
    with tempfile.TemporaryDirectory(prefix=prefix, dir=directory.parent) as scratch:
        yield Path(scratch)
        directory.mkdir(exist_ok=True)
        for stale in (path for pattern in OWN for path in directory.glob(pattern)):
            stale.unlink()
        for path in Path(scratch).iterdir():
            os.replace(path, directory / path.name)


def write_metrics(directory: Path, metrics: Mapping[str, Any]) -> Path:
    """Write the figures as JSON."""
    path = directory / METRICS
    path.write_text(json.dumps(metrics, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    return path
