"""Worker processes that never outlive the process that started them."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from multiprocessing import connection
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from types import FrameType
from typing import Any, TypeVar

from ...core import EvaluationError
from ...fork_server import fork_server

Item = TypeVar("Item")
Result = TypeVar("Result")
SIGNALS = (signal.SIGINT, signal.SIGTERM)
LONGEST_WAIT_S = 0.1


class Workers:
    """At most ``most`` processes that apply functions of a module's top level, in a ``with``.

    They are started when they are needed, and kept for what comes later.  None is left when the
    block is left, nor when SIGINT or SIGTERM ends this process, at whatever moment the signal
    comes.  Workers leave Ctrl-C to this process, and end by themselves when it is killed.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._processes: dict[Connection, ForkServerProcess] = {}
        self._before: dict[int, Any] = {}
        self._held = False
        self._noted: list[int] = []

    def __enter__(self) -> Workers:
        self._take_signals()
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def each(
        self, function: Callable[[Item], Result], items: Sequence[Item]
    ) -> Iterator[tuple[int, Result]]:
        """Yield the index of every item with what the function makes of it, as they get done.

        When the caller stops early, or at an error, all processes end.

        Raises
        ------
        EvaluationError
            When a worker has ended unasked, for want of memory for instance.
        Exception
            What the function has raised, with the worker's traceback as a note.
        """
        waiting = enumerate((function, item) for item in items)
        running: dict[Connection, int] = {}
        try:
            for link in self._enough_for(len(items)):
                self._hand_out(waiting, link, running)
            while running:
                # Not for ever: a signal that another thread took waits until this one runs.
                ready = connection.wait(list(running), LONGEST_WAIT_S)
                for link in [each for each in running if each in ready]:
                    result = self._receive(link)
                    index = running.pop(link)
                    self._hand_out(waiting, link, running)
                    yield index, result
        finally:
            if running:
                with self._undisturbed():
                    self._kill()

    def _enough_for(self, items: int) -> list[Connection]:
        """Start what is missing of as many processes as have something to do; return the links."""
        while len(self._processes) < min(self._most, items):
            self._start()
        return list(self._processes)

    def _hand_out(
        self, waiting: Iterator[tuple[int, Any]], link: Connection, running: dict[Connection, int]
    ) -> None:
        """Give a worker the next function and item, if there is one."""
        for index, task in waiting:
            with self._ended_unasked(link):
                link.send(task)
            running[link] = index
            return

    def _receive(self, link: Connection) -> Any:
        with self._ended_unasked(link):
            answer: tuple[Any, Exception | None] = link.recv()
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
        context = fork_server()
        ours, theirs = context.Pipe()
        process = context.Process(target=_serve, args=(theirs, dict(os.environ)), daemon=True)
        with self._undisturbed():
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
        while self._processes:
            link, process = self._processes.popitem()
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


def _serve(link: Connection, environment: Mapping[str, str]) -> None:
    """Apply functions to what comes with them over the link until nobody is there any more."""
    os.environ.clear()
    os.environ.update(environment)
    threading.Thread(target=_end_with_the_parent, daemon=True).start()
    while True:
        try:
            link.send(_answer(*link.recv()))
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
