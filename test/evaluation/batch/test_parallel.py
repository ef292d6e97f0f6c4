"""Many runs at once: results, refusals, defects."""

import errno

import pytest

from dualfoot_ros.core.errors import DualFootError, EvaluationError
from dualfoot_ros.evaluation.batch.parallel import Failure, Pool
from dualfoot_ros.recording import new_files


def halved(number: int) -> float:
    if number < 0:
        raise DualFootError(f"{number} is negative")
    if number == 99:
        raise OSError(2, "No such file or directory", "ninety-nine")
    return number / 2 if number != 1000 else 1 / 0


@pytest.mark.parametrize("jobs", (1, 2))
def test_every_item_is_done_once_and_what_is_refused_is_a_sentence_while_the_others_go_on(jobs):
    with Pool(jobs) as pool:
        done = list(pool.run_each(halved, [4, -1, 99, 6, 2]))
    assert len(done) == 5
    assert {each.index: each.result for each in done} == {
        0: 2.0,
        1: Failure("-1 is negative"),
        2: Failure("'ninety-nine': No such file or directory"),
        3: 3.0,
        4: 1.0,
    }


@pytest.mark.parametrize("jobs", (1, 2))
def test_a_defect_is_not_hidden(jobs):
    with pytest.raises(ZeroDivisionError), Pool(jobs) as pool:
        list(pool.run_each(halved, [4, 1000]))


def quotient(number: int, by: int) -> float:
    return halved(number) * 2 / by


def full(_: int) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("jobs", (1, 2))
def test_what_is_needed_of_every_item_comes_in_their_order_or_not_at_all(jobs):
    with Pool(jobs) as pool:
        assert pool.run_all(quotient, [(6, 2), (4, 1), (9, 3)]) == [3.0, 4.0, 3.0]
        with pytest.raises(EvaluationError, match="-1 is negative"):
            pool.run_all(quotient, [(6, 2), (-1, 1)])


@pytest.mark.parametrize("jobs", (1, 2))
def test_a_full_disk_is_an_error_of_the_system_also_in_a_worker(jobs, tmp_path):
    """So that whoever writes an output can name it."""
    with (
        Pool(jobs) as pool,
        pytest.raises(OSError, match=rf"cannot be written: .*'{tmp_path / 'report'}'") as raised,
        new_files(tmp_path / "report"),
    ):
        pool.run_all(full, [(1,), (2,)])
    assert raised.value.errno == errno.ENOSPC
