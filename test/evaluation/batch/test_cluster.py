"""Runs on a cluster: a real one of two workers, processes of which one is killed."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from processes import ROOT, environment

from dualfoot_ros.core import DualFootError, EvaluationError
from dualfoot_ros.evaluation.batch import cluster
from dualfoot_ros.evaluation.batch.parallel import Failure, Pool

distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")


@pytest.fixture(scope="module")
def address():
    """Start a scheduler and two workers, and return the address of the scheduler."""
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        host="127.0.0.1",
        env={"PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "test")])},
    ) as local:
        yield local.scheduler_address


def halved(number: int) -> float:
    if number < 0:
        raise DualFootError(f"{number} is negative")
    return number / 2


def killed_once(item: tuple[str, int]) -> int:
    """Return a number; the first worker that is asked for 3 kills itself."""
    mark, number = item
    if number == 3 and not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def broken(_: int) -> int:
    raise ZeroDivisionError("a defect")


def test_results_and_refusals_are_those_of_local_runs(address):
    items = [4, -1, 8]
    with Pool(1, address) as pool:
        there = sorted(pool.run_each(halved, items), key=lambda done: done.index)
    with Pool(1) as pool:
        assert there == list(pool.run_each(halved, items))
    assert there[1].result == Failure("-1 is negative")


def test_items_of_a_group_keep_their_indices(address):
    groups = [[(0, 4), (2, 8)], [(1, -1)]]
    with Pool(1, address) as pool:
        there = sorted(pool.run_groups(halved, groups), key=lambda done: done.index)
    assert [done.result for done in there] == [2.0, Failure("-1 is negative"), 4.0]


def test_the_work_of_a_worker_that_is_killed_is_done_by_another(address, tmp_path):
    items = [(str(tmp_path / "mark"), number) for number in range(8)]
    with Pool(1, address) as pool:
        done = {each.index: each.result for each in pool.run_each(killed_once, items)}
    assert (tmp_path / "mark").exists()
    assert done == {number: number * number for number in range(8)}


def test_a_defect_is_not_hidden(address):
    with pytest.raises(ZeroDivisionError), Pool(1, address) as pool:
        list(pool.run_each(broken, [1]))


def test_a_caller_that_stops_early_leaves_nothing_behind(address):
    with distributed.Client(address, set_as_default=False) as client, Pool(1, address) as pool:
        runs = pool.run_each(halved, list(range(50)))
        next(runs)
        runs.close()
        deadline = time.monotonic() + 60.0  # guards against hanging, and judges nothing
        while client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)):
            assert time.monotonic() < deadline
            time.sleep(0.05)


def test_an_address_where_nobody_is_is_a_sentence(monkeypatch):
    monkeypatch.setattr(cluster, "CONNECT_S", 0.2)
    with (
        pytest.raises(EvaluationError, match=r"no scheduler of dask answers at 'tcp://127"),
        Pool(1, "tcp://127.0.0.1:9") as pool,
    ):
        list(pool.run_each(halved, [1]))


def test_compare_writes_on_a_cluster_what_it_writes_here(address, tmp_path):
    compare = [sys.executable, "-m", "dualfoot_ros", "compare"]
    options = ["--methods", "zupt,idc", "--csv"]
    printed = []
    for extra in (["--jobs", "1"], ["--scheduler", address]):
        done = subprocess.run(
            [*compare, os.path.relpath(ROOT / "bags" / "demo", tmp_path), *options, *extra],
            capture_output=True,
            cwd=tmp_path,
            env=environment(),
            check=True,
        )
        rows = [line.split(b",") for line in done.stdout.splitlines()]
        timed = [k for k, name in enumerate(rows[0]) if name.startswith(b"run")]
        printed.append([[v for k, v in enumerate(row) if k not in timed] for row in rows])
    assert printed[0] == printed[1] and len(printed[0]) == 3
