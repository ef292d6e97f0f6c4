"""Output of the verbs: JSON and tables on standard output, all else on standard error."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from ..evaluation.batch import Failure
    from ..recording import Recording
    from ..recording.importers.tables import Assumption

WIDTH = 120
HEADINGS = ("foot", "what", "taken as", "by")  # of what was assumed about files of sensors
MARK = "!"  # before what the user should look at


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


def doubts(recording: Recording) -> list[str]:
    """Return a sentence for each assumption that the user should look at."""
    from ..recording.importers.tables import from_note

    found = from_note(recording.notes.get("assumptions", "[]"))
    return [
        f"{one.foot + ' foot: ' if one.foot else ''}{one.subject}: {one.value}"
        for one in found
        if one.doubtful
    ]


def assumption_lines(recording: Recording) -> list[str]:
    """Return what was assumed about the files of a recording, as the lines of a table."""
    from ..recording.importers.tables import from_note

    found = from_note(recording.notes.get("assumptions", "[]"))
    if not found:
        return []
    rows = [HEADINGS, *_merged(found)]
    widths = [max(len(row[k]) for row in rows) for k in range(len(HEADINGS))]
    return [_line(row, widths) for row in rows]


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
    return "  ".join(cells).rstrip()


def _merged(found: Iterable[Assumption]) -> list[tuple[str, ...]]:
    """Return one row for what is the same of both feet."""
    rows: dict[tuple[str, ...], list[str]] = {}
    for one in found:
        mark = f"{MARK} " if one.doubtful else ""
        rows.setdefault((one.subject, f"{mark}{one.value}", str(one.origin)), []).append(one.foot)
    return [("both" if len(set(feet)) > 1 else feet[0], *row) for row, feet in rows.items()]
