"""Many independent runs at once, in processes: results as they come, refusals named."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from typing import Generic, TypeVar

from ...core import DualFootError

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
    stops early, or is interrupted, what has not started is given up.
    """
    if jobs <= 1 or len(items) <= 1:
        for index, item in enumerate(items):
            yield Done(index, _attempt(function, item))
        return
    # spawn: a process forked from one with threads (a progress bar) may hang
    context = multiprocessing.get_context("spawn")
    workers = min(jobs, len(items))
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=_leave_signals)
    try:
        waiting = {pool.submit(_attempt, function, item): k for k, item in enumerate(items)}
        for future in as_completed(waiting):
            yield Done(waiting[future], future.result())
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _leave_signals() -> None:
    """Let the parent attend to the terminal's Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


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
