"""Output of the verbs: JSON and tables on standard output, all else on standard error."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
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


def print_note(sentence: str) -> None:
    """Print what a verb takes for granted."""
    print(f"note: {sentence}", file=sys.stderr)


def print_failures(verb: str, failures: Mapping[str, Failure]) -> None:
    """Name every run that failed, and why."""
    for name, failure in failures.items():
        print_error(verb, f"{name}: {failure.sentence}")


@contextmanager
def progress(label: str) -> Iterator[Callable[[float], None]]:
    """Show a bar while the block runs; it is given a function that takes the share done, 0-1.

    Nothing is shown when standard error is no terminal.
    """
    if not _on_terminal():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(label, total=1.0)
        yield lambda share: bar.update(task, completed=share)


@contextmanager
def status(label: str) -> Iterator[None]:
    """Show ``label`` and that something is going on, while the block runs on a terminal."""
    if not _on_terminal():
        yield
        return
    from rich.console import Console

    with Console(stderr=True).status(label):
        yield


def _on_terminal() -> bool:
    """Return whether standard error is a terminal; where it is not, rich need not be loaded."""
    return sys.stderr.isatty()
