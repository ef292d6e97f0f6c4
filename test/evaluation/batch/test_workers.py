"""Worker processes: what they give, and that none outlives whoever started it."""

import os
import signal
from pathlib import Path

import pytest

from dualfoot_ros.core import EvaluationError
from dualfoot_ros.evaluation.batch.workers import Workers

ROOT = Path(__file__).resolve().parents[2]

SCRIPT = """
import sys
sys.path.insert(0, {path!r})
from evaluation.batch.busy import busy
from dualfoot_ros.evaluation.batch.workers import Workers
{before}
if __name__ == "__main__":
    with Workers(2) as workers:
        print(list(workers.each(busy, [1, 2, 3])))
"""

LENGTHS = """
from dualfoot_ros.evaluation.batch.workers import Workers
if __name__ == "__main__":
    with Workers(1) as one:
        print(list(one.each(len, ["four"])))
"""


def tenfold(number: int) -> int:
    if number == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    if number == 17:
        raise ZeroDivisionError("seventeen")
    return 10 * number


def process_of(_: int) -> int:
    return os.getpid()


def test_results_know_their_items():
    with Workers(2) as workers:
        assert dict(workers.each(tenfold, [4, 2, 8])) == {0: 40, 1: 20, 2: 80}


def test_processes_are_started_when_they_are_needed_and_kept_for_another_function():
    with Workers(2) as workers:
        ((_, first),) = workers.each(process_of, [1])
        assert dict(workers.each(tenfold, [1])) == {0: 10}
        both = {process for _, process in workers.each(process_of, [1, 2])}
        assert first in both and len(both) == 2 and os.getpid() not in both


def test_a_caller_that_stops_early_can_start_anew():
    with Workers(2) as workers:
        early = workers.each(tenfold, list(range(20)))
        next(early)
        early.close()
        assert dict(workers.each(process_of, [1])).keys() == {0}


def environment_of(name: str) -> str | None:
    return os.environ.get(name)


def test_workers_have_the_environment_of_the_moment_and_no_other(monkeypatch):
    for value in ("first", "second"):
        monkeypatch.setenv("DUALFOOT_TEST", value)
        with Workers(1) as one:
            found = dict(one.each(environment_of, ["DUALFOOT_TEST", "PYTHONPATH"]))
            assert found == {0: value, 1: os.environ.get("PYTHONPATH")}


def test_workers_import_nothing_from_the_folder_that_the_user_is_in(tmp_path, session):
    """It is the first place where a Python that is given a command looks."""
    for folder in ("scripts", "walks"):
        (tmp_path / folder).mkdir()
    (tmp_path / "walks" / "numpy.py").write_text("import os; os.write(2, b'of the user')")
    script = tmp_path / "scripts" / "lengths.py"
    script.write_text(LENGTHS)
    ended = session(script, cwd=tmp_path / "walks").end()
    assert (ended.code, ended.out, ended.error) == (0, "[(0, 4)]\n", "")


def test_an_exception_of_a_worker_is_raised_with_where_it_was_raised():
    with pytest.raises(ZeroDivisionError, match="seventeen") as caught, Workers(1) as one:
        list(one.each(tenfold, [1, 17]))
    assert "in tenfold" in caught.value.__notes__[0]


def test_a_worker_that_is_killed_from_outside_is_a_sentence_with_its_code():
    said = f"a worker process has ended with exit code -{signal.SIGKILL.value}"
    with pytest.raises(EvaluationError, match=said), Workers(1) as one:
        list(one.each(tenfold, [1, 13, 2]))


@pytest.fixture
def working(session):
    """Start a script with two workers that are at work, and what it does before."""

    def start(before=""):
        running = session("-c", SCRIPT.format(path=str(ROOT), before=before))
        assert running.until(lambda s: s.said().count("on\n") == 2, "both at work")
        return running

    return start


def test_workers_end_by_themselves_when_their_parent_is_killed(working):
    running = working()
    running.send(signal.SIGKILL, group=False)
    ended = running.end()
    assert (ended.code, ended.out, ended.error) == (-signal.SIGKILL, "on\n" * 2, "")


def test_ctrl_c_is_a_keyboard_interrupt_of_the_caller_once_the_workers_have_gone(working):
    running = working()
    running.send(signal.SIGINT)
    ended = running.end()
    assert ended.error.count("Traceback") == 1 and ended.error.endswith("KeyboardInterrupt\n")
    assert ended.code == -signal.SIGINT


def test_a_handler_of_the_caller_decides_what_a_signal_means(working):
    before = "import signal; signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))"
    running = working(before)
    running.send(signal.SIGTERM, group=False)
    ended = running.end()
    assert (ended.code, ended.error) == (7, "")
