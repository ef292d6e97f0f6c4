"""The same runs on a cluster of dask.distributed that is there already."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from ...core import EvaluationError

Item = TypeVar("Item")
Result = TypeVar("Result")

CONNECT_S = 20.0
LOST = "KilledWorker"  # dask's error when the workers that had a task have died, one after another


def run_on_cluster(
    function: Callable[[Item], Result], items: Sequence[Item], scheduler: str
) -> Iterator[tuple[int, Result]]:
    """Yield the index of every item with its result, as workers of the cluster get them done.

    Parameters
    ----------
    function : of the top level of a module that the workers can import
    scheduler : address of the scheduler, such as tcp://host:8786

    The work of a worker that dies is done again by another one.  When the caller stops early, what
    has not been done is called off; when this process is killed, the scheduler does so.

    Raises
    ------
    EvaluationError
        When dask.distributed is not installed, no scheduler answers, or the workers of an item
        have died again and again.
    Exception
        What the function has raised.
    """
    client = _connect(scheduler)
    try:
        futures = [client.submit(function, item, pure=False, retries=0) for item in items]
        yield from _results(futures, client.loop)
    finally:
        with suppress(TimeoutError):  # the scheduler calls off what nobody waits for any more
            client.close()


def _results(futures: Sequence[Any], loop: Any) -> Iterator[tuple[int, Any]]:
    from distributed import as_completed

    index = {future.key: k for k, future in enumerate(futures)}
    for future in as_completed(list(futures), loop=loop):
        error = future.exception()
        if type(error).__name__ == LOST:
            raise EvaluationError(
                "a worker of the cluster has died at one of the runs, and so have those that "
                "tried it again; look at the logs of the workers: memory may have run out"
            )
        if error is not None:
            raise error
        yield index[future.key], future.result()
        future.release()


def _connect(scheduler: str) -> Any:
    """Return a client of the scheduler."""
    try:
        from distributed import Client
    except ImportError:
        raise EvaluationError(
            "--scheduler needs the package dask.distributed: pip install 'dualfoot_ros[cluster]'"
        ) from None
    try:
        return Client(scheduler, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise EvaluationError(
            f"no scheduler of dask answers at '{scheduler}' ({str(error) or 'it was silent'}); "
            "start one with 'dask scheduler', and give its address, such as tcp://host:8786"
        ) from error
