"""The loop that every executable runs in."""

import sys
import threading

import pytest
from rclpy.node import Node
from rclpy.task import Future

from dualfoot_ros.core.errors import DualFootError
from dualfoot_ros.nodes.ros import program
from dualfoot_ros.nodes.ros.executor import Executor
from dualfoot_ros.nodes.ros.program import _spin_until


class Watched(Future):
    """Counts the callbacks that are left on it."""

    left = 0

    def add_done_callback(self, callback):
        self.left += 1
        super().add_done_callback(callback)


@pytest.fixture
def executor(context):
    made = Executor(context=context)
    yield made
    made.shutdown()


def test_a_long_run_leaves_nothing_behind_for_the_callbacks_it_executed(bench, executor):
    node, done, executed = bench.plain(), Watched(), []

    def work():
        executed.append(1)
        if len(executed) == 200:
            done.set_result(True)

    node.create_timer(1e-4, work)
    executor.add_node(node)
    _spin_until(done, executor)
    assert len(executed) == 200 and done.left == 1


def test_an_end_that_comes_from_another_thread_wakes_an_idle_loop(bench, executor):
    done = Future()
    executor.add_node(bench.plain())
    thread = threading.Timer(0.1, lambda: done.set_result(True))
    thread.start()
    _spin_until(done, executor)
    thread.join()
    assert done.result() is True


def test_other_threads_hold_up_a_callback_for_half_a_millisecond_at_most(context, monkeypatch):
    monkeypatch.setattr(program, "Executor", lambda: Executor(context=context))
    monkeypatch.setattr(program, "_ignore_signals", lambda: None)
    node, done, usual = Node("probe", context=context), Future(), sys.getswitchinterval()
    node.create_timer(0.01, lambda: done.set_result(sys.getswitchinterval()))
    try:
        program._spin(lambda: program.Graph([node], done))
        assert done.result() == pytest.approx(0.5e-3)
    finally:
        sys.setswitchinterval(usual)


def test_an_end_by_failure_raises_it(bench, executor):
    done = Future()
    executor.add_node(bench.plain())
    thread = threading.Timer(0.1, lambda: done.set_exception(DualFootError("the source is gone")))
    thread.start()
    with pytest.raises(DualFootError, match="the source is gone"):
        _spin_until(done, executor)
    thread.join()
