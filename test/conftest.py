"""What tests of several parts need: the real walks, processes, a clock of one's own."""

import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

import pytest
from hypothesis import settings
from own_time import OwnTime, put_in_place
from processes import Session, environment

# The same examples at every run, so that a change is judged by itself; 50, for the time they take.
# To look for new ones: pytest --hypothesis-profile=explore
settings.register_profile("steady", derandomize=True, deadline=None, max_examples=50)
settings.register_profile("explore", deadline=None, max_examples=1000)
settings.load_profile("steady")

ROOT = Path(__file__).resolve().parents[1]


def pytest_collection_finish():
    """Leave what was collected out of every later search for garbage."""
    gc.freeze()


@pytest.fixture(scope="session")
def dual_feet() -> Path:
    """Folder of the dual-feet data set; the test is skipped where it is absent."""
    default = ROOT.parent / "shared" / "data" / "dual_feet"
    folder = Path(os.environ.get("DUALFOOT_DATA", default))
    if not (folder / "README.md").exists():
        pytest.skip(f"the dual-feet data set is not in {folder}; set DUALFOOT_DATA to where it is")
    return folder


Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="session")
def dualfoot_process() -> Run:
    """Run the command of this checkout as a process and return what it printed."""

    def run(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "dualfoot_ros", *map(str, arguments)],
            check=False,
            capture_output=True,
            text=True,
            cwd=cwd,
            env=environment(),
        )

    return run


@pytest.fixture(scope="session")
def dualfoot() -> Run:
    """Run the command in this process, which has imported everything, and return the same."""
    from dualfoot_ros.cli.main import main

    def run(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        words, out, error = [*map(str, arguments)], StringIO(), StringIO()
        with chdir(cwd or Path.cwd()), redirect_stdout(out), redirect_stderr(error):
            try:
                code = main(words)
            except SystemExit as end:  # --help, and what argparse refuses
                code = int(end.code or 0)
        return subprocess.CompletedProcess(words, code, out.getvalue(), error.getvalue())

    return run


@pytest.fixture
def clock(monkeypatch) -> OwnTime:
    """Return the monotonic clock of the package: silence and patience pass when the test says."""
    return put_in_place(monkeypatch)


@pytest.fixture
def session() -> Iterator[Callable[..., Session]]:
    """Start Python processes that are to be interrupted; nothing of them outlives the test."""
    started: list[Session] = []

    def start(*arguments: object, **options) -> Session:
        started.append(Session(*arguments, **options))
        return started[-1]

    yield start
    for each in started:
        each.close()
