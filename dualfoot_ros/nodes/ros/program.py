"""Start-up and shutdown of every executable of the package, in one place.

SIGINT and SIGTERM end a program with exit code 0; a wrong parameter, file or argument with 2 and
one sentence on stderr.
"""

from __future__ import annotations

import argparse
import re
import signal
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future
from rclpy.utilities import remove_ros_args

from ...core import DualFootError, ParameterSpec, os_error_text
from .executor import Executor

SOURCE_LINE = re.compile(r" ?, at \S+:\d+")  # where in rcl's own source an error was found
STOPPED = (KeyboardInterrupt, ExternalShutdownException)
SWITCH_S = 0.5e-3  # for which another thread may hold up a sample; 5 ms is Python's own


@dataclass(frozen=True)
class Program:
    """An executable: its name, and what ``--help`` prints."""

    name: str
    summary: str
    examples: str
    specs: Sequence[ParameterSpec] = ()

    def check_arguments(self, argv: Sequence[str]) -> None:
        """Answer --help; refuse arguments that ROS does not use or cannot read."""
        parser = argparse.ArgumentParser(
            prog=self.name,
            description=self.summary,
            epilog=f"examples:\n{self.examples}\nparameters (-p NAME:=VALUE):\n{self._table()}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            usage=f"{self.name} [-h] [--ros-args -p NAME:=VALUE --params-file YAML -r FROM:=TO]",
        )
        with _ros_arguments():
            rest = remove_ros_args(["", *argv])[1:]
        parser.parse_args(rest)

    def _table(self) -> str:
        lines = [
            f"  {spec.name}  {spec.description} ({spec.allowed}; default {spec.default!r})"
            for spec in self.specs
        ]
        return "\n".join(lines)


@dataclass(frozen=True)
class Graph:
    """Nodes of one process; the program ends with ``done``, or never when that is None."""

    nodes: Sequence[Node]
    done: Future | None = None


def run_nodes(
    program: Program, build: Callable[[], Graph], argv: Sequence[str] | None = None
) -> int:
    """Run the nodes that ``build`` makes until a signal or their end; return the exit code."""
    argv = sys.argv[1:] if argv is None else list(argv)
    try:
        program.check_arguments(argv)
        with started(argv):
            _spin(build)
    except STOPPED:
        return 0
    except DualFootError as error:
        return _refuse(program, str(error))
    except ParameterException as error:  # of a parameter that rclpy declares: use_sim_time
        return _refuse(program, f"a parameter of ROS cannot be used: {in_one_line(error)}")
    except OSError as error:
        return _refuse(program, os_error_text(error))
    finally:
        _ignore_signals()
    return 0


@contextmanager
def started(argv: Sequence[str]) -> Iterator[None]:
    """Start the default context of rclpy for the block; always shut it down.

    Raises
    ------
    DualFootError
        When ROS cannot read its arguments or parameter files.
    """
    # rclpy ends the context at a signal; a KeyboardInterrupt as well could come anywhere, even in
    # a callback of the import machinery, which can only print it.  What comes before rclpy listens
    # is remembered.
    came: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: came.append(number))
    with _ros_arguments():
        rclpy.init(args=["", *argv])
    if came:
        rclpy.try_shutdown()  # as rclpy does it at a signal from here on
    try:
        yield
    except Exception:
        if rclpy.ok():
            raise
        # The signal came between two steps of the start-up, and the context was gone for the next.
        raise ExternalShutdownException from None
    finally:
        _ignore_signals()
        rclpy.try_shutdown()


@contextmanager
def _ros_arguments() -> Iterator[None]:
    """Turn the errors of rcl about arguments and parameter files into one sentence."""
    try:
        yield
    except Exception as error:  # the classes of rcl's errors have no public name
        reason = in_one_line(error)
        raise DualFootError(f"the arguments after --ros-args cannot be read: {reason}") from None


def in_one_line(error: Exception) -> str:
    """Return the message of rcl, without line breaks and without the place in its source."""
    return SOURCE_LINE.sub("", " ".join(str(error).split()))


def _spin(build: Callable[[], Graph]) -> None:
    """Run the nodes that ``build`` makes; a signal finds an executor that is whole."""
    sys.setswitchinterval(SWITCH_S)
    executor, nodes = Executor(), tuple[Node, ...]()
    try:
        graph = build()
        nodes = tuple(graph.nodes)
        for node in nodes:
            executor.add_node(node)
        _spin_until(graph.done or Future(), executor)
    finally:
        _ignore_signals()
        executor.shutdown()
        destroy(nodes)


def _spin_until(done: Future, executor: Executor) -> None:
    """Spin until ``done`` is done; raise the error that ended it, if there was one.

    The executor's own method for this leaves something on the future for every callback that it
    executes, so the memory of a process that runs for days would grow without bound.
    """
    done.add_done_callback(lambda _: executor.create_task(lambda: None))  # wakes it
    while executor.context.ok() and not done.done():
        executor.spin_once()
    if done.done():
        done.result()


def destroy(nodes: Iterable[Node]) -> None:
    """Destroy nodes, in the reverse order of their making."""
    for node in reversed(list(nodes)):
        node.destroy_node()


def _ignore_signals() -> None:
    """Ignore signals: a terminal can send SIGINT twice, and the second must not interrupt."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)


def _refuse(program: Program, reason: str) -> int:
    sys.stderr.write(f"{program.name}: error: {reason}\n")
    return 2
