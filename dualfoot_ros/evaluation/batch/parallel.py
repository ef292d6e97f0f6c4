"""Many independent runs at once, in processes: results as they come, refusals named."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, TypeVar

from ...core import DualFootError, EvaluationError
from .cluster import run_on_cluster
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
    function: Callable[[Item], Result],
    items: Sequence[Item],
    jobs: int,
    scheduler: str | None = None,
) -> Iterator[Done[Result]]:
    """Yield what ``function`` (of a module's top level) makes of every item, as they get done.

    With one job nothing leaves this process; with a ``scheduler`` all is done by the workers of a
    cluster (:mod:`.cluster`).  An input that is refused (a DualFootError, or an OSError) becomes a
    :class:`Failure`; any other exception ends everything.  When the caller stops early, or a
    signal ends this process, the other processes end at once.
    """
    attempt = partial(_attempt, function)
    if scheduler is not None:
        for index, result in run_on_cluster(attempt, items, scheduler):
            yield Done(index, result)
        return
    if jobs <= 1 or len(items) <= 1:
        for index, item in enumerate(items):
            yield Done(index, attempt(item))
        return
    with Workers(attempt, min(jobs, len(items))) as workers:
        for index, result in workers.each(items):
            yield Done(index, result)


def run_groups(
    function: Callable[[Item], Result],
    groups: Sequence[Sequence[tuple[int, Item]]],
    jobs: int,
    scheduler: str | None = None,
) -> Iterator[Done[Result]]:
    """Do as :func:`run_each` with items in groups, those of one in a row in one process.

    Each item has its index with it.  Items that share what is slow to get (a recording) belong
    into one group.
    """
    for done in run_each(partial(_attempt_all, function), groups, jobs, scheduler):
        assert not isinstance(done.result, Failure)
        yield from done.result


def _attempt_all(
    function: Callable[[Item], Result], group: Sequence[tuple[int, Item]]
) -> list[Done[Result]]:
    return [Done(index, _attempt(function, item)) for index, item in group]


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


def run_all(
    function: Callable[..., Result], items: Sequence[tuple[Any, ...]], jobs: int
) -> list[Result]:
    """Return what ``function`` makes of the arguments in every item, in their order.

    Raises
    ------
    EvaluationError
        When one of them is refused; the others are given up.
    """
    results: dict[int, Result] = {}
    for done in run_each(partial(_called, function), items, jobs):
        if isinstance(done.result, Failure):
            raise EvaluationError(done.result.sentence)
        results[done.index] = done.result
    return [results[index] for index in sorted(results)]


def _called(function: Callable[..., Result], arguments: tuple[Any, ...]) -> Result:
    return function(*arguments)
