"""Many independent runs at once, in processes: results as they come, refusals named."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Generic, TypeVar

from ...core import DualFootError
from .workers import Workers

Item = TypeVar("Item")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Failure:
    """Why a run gave no result, as a sentence."""

    sentence: str


@dataclass(frozen=True)
class Done(Generic[Result]):
    """What came of the item at ``index``."""

    index: int
    result: Result | Failure


def default_jobs() -> int:
    """Return how many processes are sensible here."""
    return max(1, len(os.sched_getaffinity(0)))


def run_each(
    function: Callable[[Item], Result], items: Sequence[Item], jobs: int
) -> Iterator[Done[Result]]:
    """Yield what ``function`` (of a module's top level) makes of every item, as they get done.

    With one job nothing leaves this process.  An input that is refused (a DualFootError, or an
    OSError) becomes a :class:`Failure`; any other exception ends everything.  When the caller
    stops early, or a signal ends this process, the other processes end at once.
    """
    attempt = partial(_attempt, function)
    if jobs <= 1 or len(items) <= 1:
        for index, item in enumerate(items):
            yield Done(index, attempt(item))
        return
    with Workers(attempt, min(jobs, len(items))) as workers:
        for index, result in workers.each(items):
            yield Done(index, result)


def _attempt(function: Callable[[Item], Result], item: Item) -> Result | Failure:
    try:
        return function(item)
    except DualFootError as error:
        return Failure(str(error))
    except OSError as error:
        if error.strerror is None:
            raise
        where = f"'{error.filename}': " if error.filename else ""
        return Failure(f"{where}{error.strerror}")
