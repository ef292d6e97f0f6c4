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
    with Workers(busy, 2) as workers:
        print(list(workers.each([1, 2, 3])))
"""


def tenfold(number: int) -> int:
    if number == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    if number == 17:
        raise ZeroDivisionError("seventeen")
    return 10 * number


def test_results_know_their_items_and_a_second_round_uses_the_same_processes():
    with Workers(tenfold, 2) as workers:
        assert dict(workers.each([4, 2, 8])) == {0: 40, 1: 20, 2: 80}
        assert dict(workers.each([1])) == {0: 10}


def test_an_exception_of_a_worker_is_raised_with_where_it_was_raised():
    with pytest.raises(ZeroDivisionError, match="seventeen") as caught, Workers(tenfold, 1) as one:
        list(one.each([1, 17]))
    assert "in tenfold" in caught.value.__notes__[0]


def test_a_worker_that_is_killed_from_outside_is_a_sentence_with_its_code():
    said = f"a worker process has ended with exit code -{signal.SIGKILL.value}"
    with pytest.raises(EvaluationError, match=said), Workers(tenfold, 1) as one:
        list(one.each([1, 13, 2]))


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
