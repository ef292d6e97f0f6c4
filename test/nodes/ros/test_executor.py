"""The executor calls what rclpy's calls, and holds nothing that was destroyed."""

import gc
import sys
import threading

import pytest
import rclpy
from processes import PATIENCE_S
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

from dualfoot_ros.nodes.ros import executor as executor_module
from dualfoot_ros.nodes.ros import qos
from dualfoot_ros.nodes.ros.executor import Executor


@pytest.fixture
def got():
    """Return what callbacks have taken."""
    return []


def test_every_message_comes_in_its_order_with_its_numbers_where_they_are_asked_for(bench, got):
    node = bench.plain()
    numbers = []

    def take(message, info):
        got.append(message.data)
        numbers.append(info["publication_sequence_number"])

    node.create_subscription(Int32, "numbers", take, 100)
    publisher = node.create_publisher(Int32, "numbers", 100)
    bench.until(publisher.get_subscription_count)
    for k in range(50):
        publisher.publish(Int32(data=k))
    bench.until(lambda: len(got) == 50)
    assert got == list(range(50))
    assert [number - numbers[0] for number in numbers] == got


def test_the_wait_set_is_made_once_for_many_messages(bench, got, monkeypatch):
    node = bench.plain()
    node.create_subscription(Int32, "numbers", got.append, 100)
    publisher = node.create_publisher(Int32, "numbers", 100)
    bench.until(publisher.get_subscription_count)
    publisher.publish(Int32())
    bench.until(lambda: got)
    made, usual = [], executor_module.KeptWaitSet
    monkeypatch.setattr(
        executor_module, "KeptWaitSet", lambda *given: made.append(1) or usual(*given)
    )
    for k in range(50):
        publisher.publish(Int32())
        bench.until(lambda expected=k + 2: len(got) == expected)
    assert len(made) <= 2


def test_a_timer_keeps_its_period_and_one_that_is_cancelled_is_silent(bench, got):
    node = bench.plain()
    kept = node.create_timer(0.01, lambda: got.append("kept"))
    other = node.create_timer(0.01, lambda: (got.append("other"), other.cancel()))
    bench.until(lambda: got.count("kept") >= 5)
    assert got.count("other") == 1 and not kept.is_canceled()


@pytest.mark.parametrize("look_s", [0.0, 3600.0])
def test_a_timer_that_is_always_due_is_called_once_a_turn(context, got, monkeypatch, look_s):
    """... so that the caller sees between two calls whether it is to end."""
    monkeypatch.setattr(executor_module, "LOOK_S", look_s)
    node, executor = Node("busy", context=context), Executor(context=context)
    node.create_timer(1e-9, lambda: got.append(1))
    executor.add_node(node)
    for turn in range(1, 51):
        executor.spin_once(timeout_sec=1.0)
        assert len(got) <= turn
    assert len(got) > 40
    executor.shutdown()
    node.destroy_node()


def test_a_service_answers(bench, got):
    node = bench.plain()

    def answer(_, response):
        response.message = "here"
        return response

    node.create_service(Trigger, "ask", answer)
    client = bench.plain("asking").create_client(Trigger, "ask")
    bench.until(client.service_is_ready)
    asked = client.call_async(Trigger.Request())
    bench.until(asked.done)
    assert asked.result().message == "here"


def test_what_a_callback_destroys_gets_nothing_more_and_what_it_makes_does(bench, got):
    node = bench.plain()
    publisher = node.create_publisher(Int32, "numbers", 100)

    def move(message):
        got.append(("old", message.data))
        for each in olds:
            node.destroy_subscription(each)
        node.create_subscription(Int32, "numbers", lambda m: got.append(("new", m.data)), 100)

    # Both have the same message in one round; the first that takes it destroys both.
    olds = [node.create_subscription(Int32, "numbers", move, 100) for _ in range(2)]
    bench.until(lambda: publisher.get_subscription_count() == 2)
    publisher.publish(Int32(data=1))
    bench.until(lambda: got)
    bench.until(lambda: publisher.get_subscription_count() == 1, "the old ones are gone")
    publisher.publish(Int32(data=2))
    bench.until(lambda: len(got) == 2)
    assert got == [("old", 1), ("new", 2)]


def test_what_a_callback_raises_is_raised(bench):
    node = bench.plain()

    def fail(*_):
        raise ValueError("no")

    node.create_timer(0.01, fail)
    with pytest.raises(ValueError, match="no"):
        bench.until(lambda: False)


def test_a_task_of_another_thread_runs_at_once(bench, context, got):
    executor = Executor(context=context)
    executor.add_node(bench.plain())
    thread = threading.Timer(0.05, lambda: executor.create_task(lambda: got.append(1)))
    thread.start()
    while not got:
        executor.spin_once(timeout_sec=PATIENCE_S)
    thread.join()
    executor.shutdown()


def test_events_of_a_publisher_are_looked_at(bench, got):
    node = bench.plain()
    events = PublisherEventCallbacks(incompatible_qos=got.append)
    node.create_publisher(Int32, "numbers", qos.sensor(10), event_callbacks=events)
    bench.plain("strict").create_subscription(Int32, "numbers", print, qos.result())
    bench.until(lambda: got)


def spin_for_ever(executor):
    while True:
        executor.spin_once(timeout_sec=PATIENCE_S)


def test_a_context_that_ends_ends_the_wait(context, bench):
    executor = Executor(context=context)
    executor.add_node(bench.plain())
    thread = threading.Timer(0.05, lambda: rclpy.try_shutdown(context=context))
    thread.start()
    with pytest.raises(ExternalShutdownException):
        spin_for_ever(executor)
    thread.join()
    executor.shutdown()


@pytest.mark.parametrize("over", [False, True])
@pytest.mark.parametrize(("kind", "talks"), [(SingleThreadedExecutor, True), (Executor, False)])
def test_an_executor_that_cannot_be_made_goes_without_a_word(monkeypatch, kind, talks, over):
    """The one of rclpy does not: destructors fail, of its own and of its guard."""
    said, context = [], rclpy.Context()
    monkeypatch.setattr(sys, "unraisablehook", lambda each: said.append(str(each.object)))
    if over:
        rclpy.init(context=context)
        rclpy.shutdown(context=context)
    with pytest.raises(Exception, match="context" if talks else None):
        kind(context=context)
    gc.collect()
    assert bool(said) is talks
