"""Output of the verbs: JSON and tables on standard output, errors and warnings on the other."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from ..evaluation.batch import Failure

WIDTH = 120


def print_json(document: Mapping[str, Any]) -> None:
    """Print one JSON object; what is not finite becomes null."""
    import json

    from ..evaluation import plain

    print(json.dumps(plain(document), allow_nan=False))


def table_console(width: int = WIDTH) -> Console:
    """Return a console for tables, ``width`` columns wide where the output is no terminal."""
    from rich.console import Console

    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = width
    return console


def print_paths(paths: Iterable[Path]) -> None:
    """Print the files that were written, one a line."""
    for path in paths:
        print(path)


def print_error(verb: str, sentence: str) -> None:
    """Print why a verb, or a part of it, cannot be done."""
    print(f"dualfoot {verb}: error: {sentence}", file=sys.stderr)


def print_warning(verb: str, sentence: str) -> None:
    """Print a warning about a result."""
    print(f"dualfoot {verb}: warning: {sentence}", file=sys.stderr)


def print_note(line: str) -> None:
    """Print a line that belongs neither to the results nor to the warnings."""
    print(line, file=sys.stderr)


def print_failures(verb: str, failures: Mapping[str, Failure]) -> None:
    """Name every run that failed, and why."""
    for name, failure in failures.items():
        print_error(verb, f"{name}: {failure.sentence}")
