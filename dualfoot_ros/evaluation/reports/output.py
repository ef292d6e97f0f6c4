"""The folder of a report: written whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ...core import EvaluationError
from ...recording import new_files

METRICS = "metrics.json"
OWN = (METRICS, "*.tum", "*.png")
"""What earlier reports may have left in the folder of a report."""


def check_directory(directory: Path) -> None:
    """Raise :class:`EvaluationError` when reports cannot go to ``directory``."""
    if directory.exists() and not directory.is_dir():
        raise EvaluationError(f"output '{directory}' is a file; allowed is a folder or a new name")


@contextmanager
def report_folder(directory: Path) -> Iterator[Path]:
    """Yield an empty folder; its files go to ``directory`` when the block ends well.

    An existing folder is kept; of its files those of an earlier report are replaced.

    Raises
    ------
    EvaluationError
        When ``directory`` is a file.
    OSError
        When nothing can be written there.
    """
    check_directory(directory)
    with new_files(directory, replacing=OWN) as folder:
        yield folder


def write_json(path: Path, document: Mapping[str, Any]) -> Path:
    """Write plain values as JSON and return the path."""
    path.write_text(json.dumps(document, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    return path
