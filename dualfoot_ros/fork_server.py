"""The process that workers are forked from, once it has imported what they need.

A fork of this process would copy locks that its threads hold; that one only imports and waits, and
numpy's library ends its threads before a fork.  It starts while this process imports the same, it
does so once for all workers, and it ends with this process.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import forkserver, resource_tracker
from multiprocessing.context import ForkServerContext
from pathlib import Path

PRELOADED = ["dualfoot_ros.evaluation.batch"]


def fork_server() -> ForkServerContext:
    """Return the context whose processes are forked there; the server is started, not waited for.

    Neither it nor a fork of it ever sees SIGINT, not even while it imports.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(PRELOADED)
    resource_tracker.ensure_running()  # started with the server, it would lift the block
    with _sigint_blocked(), _same_paths():
        forkserver.ensure_running()
    return context


def kill_fork_server() -> None:
    """End the server at once, even while it imports; it would have ended a little after us."""
    pid = getattr(forkserver._forkserver, "_forkserver_pid", None)  # noqa: SLF001 - not to be asked
    if pid is not None:
        os.kill(pid, signal.SIGKILL)


@contextmanager
def _sigint_blocked() -> Iterator[None]:
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _same_paths() -> Iterator[None]:
    """Let a Python that is started here import from where this one does.

    By itself it would look into the current folder first, whatever a user keeps there.
    """
    paths = os.pathsep.join(str(Path(path).absolute()) for path in sys.path)
    before = {name: os.environ.get(name) for name in ("PYTHONSAFEPATH", "PYTHONPATH")}
    os.environ.update(PYTHONSAFEPATH="1", PYTHONPATH=paths)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
