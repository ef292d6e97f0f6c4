"""The folder of a report: written whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ...core import EvaluationError
from ...recording import is_bag, new_files

METRICS = "metrics.json"
OWN = (
    METRICS,
    "*.tum",
    "*.png",
    "report.html",
    "strides.csv",
    *(f"person.{kind}" for kind in ("tum", "csv", "geojson", "kml", "gpx")),
    "compare.json",
    "compare.csv",
    "consistency.json",
    "estimate_bag",
)
"""What earlier reports may have left in the folder of a report."""

MARKS = (METRICS, "report.html", "compare.json", "consistency.json")
"""Files by which an earlier report is known."""


def check_directory(directory: Path, *, overwrite: bool = False) -> None:
    """Raise :class:`EvaluationError` when a report must not go to ``directory``.

    That is a file, a recording (or a folder in one), or, unless ``overwrite`` is set, a folder
    that holds an earlier report.
    """
    _check_folder(directory)
    earlier = [name for name in MARKS if (directory / name).exists()]
    if earlier and not overwrite:
        raise EvaluationError(
            f"output '{directory}' holds an earlier report ({earlier[0]}); choose another folder "
            "or give --overwrite"
        )


def _check_folder(directory: Path) -> None:
    if directory.exists() and not directory.is_dir():
        raise EvaluationError(f"output '{directory}' is a file; allowed is a folder or a new name")
    for folder in (directory.resolve(), *directory.resolve().parents):
        if is_bag(folder):
            raise EvaluationError(
                f"output '{directory}' would be written into the recording '{folder}'; choose a "
                "folder outside of it"
            )


@contextmanager
def report_folder(directory: Path) -> Iterator[Path]:
    """Yield an empty folder; its files go to ``directory`` when the block ends well.

    An existing folder is kept; of its files those of an earlier report are replaced.

    Raises
    ------
    EvaluationError
        When ``directory`` is a file, or lies in a recording.
    OSError
        When nothing can be written there.
    """
    _check_folder(directory)
    with new_files(directory, replacing=OWN) as folder:
        yield folder


def write_json(path: Path, document: Mapping[str, Any]) -> Path:
    """Write plain values as JSON and return the path."""
    path.write_text(json.dumps(document, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    return path
