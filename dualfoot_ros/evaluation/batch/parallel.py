"""Many independent runs at once, in processes: results as they come, refusals named."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Generic, TypeVar

from ...core import DualFootError, EvaluationError
from .cluster import run_on_cluster
from .workers import Workers

Item = TypeVar("Item")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Failure:
    """Why a run gave no result, as a sentence.

    ``of_system`` is number, text and file of an error of the system, where it was one.
    """

    sentence: str
    of_system: tuple[int | None, str, str | None] | None = field(default=None, compare=False)

    def error(self) -> EvaluationError | OSError:
        """Return the error to raise for it."""
        return OSError(*self.of_system) if self.of_system else EvaluationError(self.sentence)


@dataclass(frozen=True)
class Done(Generic[Result]):
    """What came of the item at ``index``."""

    index: int
    result: Result | Failure


def default_jobs() -> int:
    """Return how many processes are sensible here."""
    return max(1, len(os.sched_getaffinity(0)))


class Pool:
    """Where many runs are done, for a ``with`` block: here, in processes, or on a cluster.

    With one job nothing leaves this process; with more, the worker processes start when they are
    first needed, and serve everything that is asked for in the block.  With a ``scheduler`` runs
    are done by the workers of a cluster (:mod:`.cluster`), but for :meth:`run_all`.  When the
    caller stops early, or a signal ends this process, the other processes end at once.
    """

    def __init__(self, jobs: int, scheduler: str | None = None) -> None:
        self._workers = Workers(jobs) if jobs > 1 else None
        self._scheduler = scheduler

    def __enter__(self) -> Pool:
        if self._workers is not None:
            self._workers.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        if self._workers is not None:
            self._workers.__exit__()

    def run_each(
        self, function: Callable[[Item], Result], items: Sequence[Item]
    ) -> Iterator[Done[Result]]:
        """Yield what ``function`` (of a module's top level) makes of every item, as they get done.

        An input that is refused (a DualFootError, or an OSError) becomes a :class:`Failure`; any
        other exception ends everything.
        """
        attempt = partial(_attempt, function)
        if self._scheduler is None:
            yield from self._run_here(attempt, items)
            return
        for index, result in run_on_cluster(attempt, items, self._scheduler):
            yield Done(index, result)

    def run_groups(
        self, function: Callable[[Item], Result], groups: Sequence[Sequence[tuple[int, Item]]]
    ) -> Iterator[Done[Result]]:
        """Do as :meth:`run_each` with items in groups, those of one in a row in one process.

        Each item has its index with it.  Items that share what is slow to get (a recording) belong
        into one group.
        """
        for done in self.run_each(partial(_attempt_all, function), groups):
            assert not isinstance(done.result, Failure)
            yield from done.result

    def run_all(
        self, function: Callable[..., Result], items: Sequence[tuple[Any, ...]]
    ) -> list[Result]:
        """Return what ``function`` makes of the arguments in every item, in their order.

        Raises
        ------
        EvaluationError, OSError
            When one of them is refused; the others are given up.
        """
        results: dict[int, Result] = {}
        for done in self._run_here(partial(_attempt, partial(_called, function)), items):
            if isinstance(done.result, Failure):
                raise done.result.error()
            results[done.index] = done.result
        return [results[index] for index in sorted(results)]

    def _run_here(
        self, attempt: Callable[[Item], Result | Failure], items: Sequence[Item]
    ) -> Iterator[Done[Result]]:
        if self._workers is None or len(items) <= 1:
            for index, item in enumerate(items):
                yield Done(index, attempt(item))
            return
        for index, result in self._workers.each(attempt, items):
            yield Done(index, result)


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
        told = error.errno, error.strerror, error.filename
        return Failure(f"{where}{error.strerror}", told)


def _called(function: Callable[..., Result], arguments: tuple[Any, ...]) -> Result:
    return function(*arguments)
