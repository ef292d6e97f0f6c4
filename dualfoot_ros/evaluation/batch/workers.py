"""Worker processes that never outlive the process that started them."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing import connection, resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from types import FrameType
from typing import Any, Generic, TypeVar

from ...core import EvaluationError

Item = TypeVar("Item")
Result = TypeVar("Result")
SIGNALS = (signal.SIGINT, signal.SIGTERM)
LONGEST_WAIT_S = 0.1


class Workers(Generic[Item, Result]):
    """Processes that apply one function of a module's top level, for a ``with`` block.

    None is left when the block is left, nor when SIGINT or SIGTERM ends this process, at whatever
    moment the signal comes.  Workers leave Ctrl-C to this process, and end by themselves when it
    is killed.
    """

    def __init__(self, function: Callable[[Item], Result], count: int) -> None:
        self._function, self._count = function, count
        self._processes: dict[Connection, SpawnProcess] = {}
        self._before: dict[int, Any] = {}
        self._held = False
        self._noted: list[int] = []

    def __enter__(self) -> Workers[Item, Result]:
        self._take_signals()
        try:
            for _ in range(self._count):
                self._start()
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def each(self, items: Sequence[Item]) -> Iterator[tuple[int, Result]]:
        """Yield the index of every item with its result, as they get done.

        Raises
        ------
        EvaluationError
            When a worker has ended unasked, for want of memory for instance.
        Exception
            What the function has raised, with the worker's traceback as a note.
        """
        waiting = iter(enumerate(items))
        running: dict[Connection, int] = {}
        for link in self._processes:
            self._hand_out(waiting, link, running)
        while running:
            # Not for ever: a signal that another thread took is attended to when this one runs.
            ready = connection.wait(list(running), LONGEST_WAIT_S)
            for link in [each for each in running if each in ready]:
                index, result = running.pop(link), self._receive(link)
                self._hand_out(waiting, link, running)
                yield index, result

    def _hand_out(
        self, waiting: Iterator[tuple[int, Item]], link: Connection, running: dict[Connection, int]
    ) -> None:
        """Give a worker the next item, if there is one."""
        for index, item in waiting:
            with self._ended_unasked(link):
                link.send(item)
            running[link] = index
            return

    def _receive(self, link: Connection) -> Result:
        with self._ended_unasked(link):
            answer: tuple[Result, Exception | None] = link.recv()
        result, error = answer
        if error is not None:
            raise error
        return result

    @contextmanager
    def _ended_unasked(self, link: Connection) -> Iterator[None]:
        """Say of a link that is broken what became of the worker behind it."""
        try:
            yield
        except (EOFError, OSError):
            self._processes[link].join()
            code = self._processes[link].exitcode
            raise EvaluationError(f"a worker process has ended with exit code {code}") from None

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")  # a fork copies locks that threads hold
        ours, theirs = context.Pipe()
        process = context.Process(target=_serve, args=(theirs, self._function), daemon=True)
        with self._undisturbed(), _sigint_blocked():
            process.start()
            self._processes[ours] = process
        theirs.close()

    def _end(self) -> None:
        with self._undisturbed():
            self._kill()
            self._return_signals()

    def _kill(self) -> None:
        """End every worker, whatever it does: nothing it has is worth keeping."""
        for process in self._processes.values():
            process.kill()
        for link, process in self._processes.items():
            process.join()
            link.close()

    # A signal may come between any two lines: while a process is started it is only noted.

    @contextmanager
    def _undisturbed(self) -> Iterator[None]:
        self._held = True
        try:
            yield
        finally:
            self._held = False
            while self._noted:
                self._obey(self._noted.pop(), None)

    def _take_signals(self) -> None:
        """Get the signals that would end this process, if they would: only its main thread can."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number in SIGNALS:
            if signal.getsignal(number) not in (signal.SIG_IGN, None):
                self._before[number] = signal.signal(number, self._signalled)

    def _return_signals(self) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)

    def _signalled(self, number: int, frame: FrameType | None) -> None:
        if self._held:
            self._noted.append(number)
        else:
            self._obey(number, frame)

    def _obey(self, number: int, frame: FrameType | None) -> None:
        """Do what the signal would have done without us, but end the workers before the process.

        A handler of the caller's, such as that of KeyboardInterrupt, makes us leave our block.
        """
        before = self._before[number]
        if callable(before):
            before(number, frame)
            return
        self._kill()
        signal.signal(number, before)
        signal.raise_signal(number)


@contextmanager
def _sigint_blocked() -> Iterator[None]:
    """Let a process that is started here never see SIGINT, not even while it imports."""
    resource_tracker.ensure_running()  # started with the first process, it would lift the block
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(link: Connection, function: Callable[[Item], Result]) -> None:
    """Apply the function to what comes over the link until nobody is there any more."""
    threading.Thread(target=_end_with_the_parent, daemon=True).start()
    while True:
        try:
            link.send(_answer(function, link.recv()))
        except (EOFError, ConnectionError):
            return


def _answer(
    function: Callable[[Item], Result], item: Item
) -> tuple[Result | None, Exception | None]:
    """Return the result, or the exception with where in the worker it was raised."""
    try:
        return function(item), None
    except Exception as error:
        error.add_note(f"in a worker process:\n{traceback.format_exc()}")
        return None, error


def _end_with_the_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)
