"""Executor that keeps its wait set, and calls the callbacks of messages and timers itself.

For each callback the one of rclpy asks every entity of every node whether it may run, makes a wait
set, a task and two coroutines, and then wakes itself once more: at 400 samples a second that
costs more than the filter and its messages.  Here the entities are gathered once, until
one is made or destroyed.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from contextlib import ExitStack, suppress
from typing import Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor, TimeoutException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.timer import Timer
from rclpy.utilities import get_default_context

LOOK_S = 1.0  # between looks at the events of publishers and subscriptions, as a QoS that misfits
KINDS = ("subscription", "guard_condition", "timer", "client", "service")


class KeptWaitSet:
    """Entities of nodes with the wait set for them; held, so that none is destroyed meanwhile."""

    def __init__(self, nodes: Iterable[Node], guards: Sequence[Any], context: Context) -> None:
        """Hold what ``nodes`` have now, and ``guards``, until :meth:`release`."""
        nodes, self._held = list(nodes), ExitStack()
        found: dict[str, list[Any]] = {
            "subscription": [each for node in nodes for each in node.subscriptions],
            "guard_condition": [*guards, *(each for node in nodes for each in node.guards)],
            "timer": [each for node in nodes for each in node.timers],
            "client": [each for node in nodes for each in node.clients],
            "service": [each for node in nodes for each in node.services],
        }
        kept = {kind: [each for each in found[kind] if self._hold(each)] for kind in KINDS}
        self._held.enter_context(context.handle)
        self._by_pointer = {e.handle.pointer: e for each in kept.values() for e in each}
        counts = [len(kept[kind]) for kind in KINDS]
        self._set = rclpy_implementation.WaitSet(*counts, 0, context.handle)
        adders = {kind: getattr(self._set, f"add_{kind}") for kind in KINDS}
        self._additions = [(adders[kind], e.handle) for kind in KINDS for e in kept[kind]]

    def _hold(self, entity: Any) -> bool:
        try:
            self._held.enter_context(entity.handle)
        except InvalidHandle:  # destroyed, and still listed
            return False
        return True

    def release(self) -> None:
        """Let go: what was destroyed meanwhile goes now."""
        self._held.close()

    def wait(self, timeout_s: float) -> None:
        """Wait until an entity is ready, at most ``timeout_s``."""
        self._set.clear_entities()
        for add, handle in self._additions:
            add(handle)
        self._set.wait(round(1e9 * timeout_s))

    def ready(self, kind: str) -> list[Any]:
        """Return the entities of a kind that are ready."""
        return [self._by_pointer[each] for each in self._set.get_ready_entities(kind)]


class Executor(SingleThreadedExecutor):
    """Calls callbacks in the thread that spins, as rclpy's, whose nodes and shutdown it has.

    Messages and timers have callbacks that are functions, no coroutines.  All else (services,
    tasks, events) is left to rclpy.
    """

    # rclpy's destructor reads it, where a signal has ended the context before it was set.
    _sigint_gc = None

    def __init__(self, *, context: Context | None = None) -> None:
        """Take the default context where none is given.

        Raises
        ------
        ExternalShutdownException
            When the context has ended.
        """
        # rclpy would leave a guard half made, whose destructor prints a traceback.
        if not (context or get_default_context()).ok():
            raise ExternalShutdownException
        super().__init__(context=context)
        self._kept: KeptWaitSet | None = None
        self._look_s = 0.0

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait, at most ``timeout_sec`` s, and call the callbacks of all that is ready.

        Raises
        ------
        ExternalShutdownException
            When the context has ended.
        """
        if self._kept is None:
            guards = (self._guard, self._sigint_gc)
            self._kept = KeptWaitSet(self.get_nodes(), guards, self.context)
        left_s = max(0.0, self._look_s - time.monotonic())
        self._kept.wait(left_s if timeout_sec is None else min(left_s, timeout_sec))
        if self._is_shutdown:
            return
        if not self.context.ok():
            raise ExternalShutdownException
        self._call_ready(self._kept)

    def _call_ready(self, kept: KeptWaitSet) -> None:
        for timer in kept.ready("timer"):
            _call_timer(timer)
        for subscription in kept.ready("subscription"):
            _call_subscription(subscription)
        changed = bool(kept.ready("guard_condition"))
        if changed:
            self._let_go()
        if changed or kept.ready("service") or kept.ready("client") or self._is_look_due():
            self._call_others()

    def _is_look_due(self) -> bool:
        return time.monotonic() >= self._look_s

    def can_execute(self, entity: Any) -> bool:
        """Return whether rclpy may call it: no timer and no message, which may never end."""
        return not isinstance(entity, (Timer, Subscription)) and super().can_execute(entity)

    def _call_others(self) -> None:
        """Have rclpy call what else is ready, until nothing is."""
        self._look_s = time.monotonic() + LOOK_S
        with suppress(TimeoutException):
            while True:
                handler, _, _ = self.wait_for_ready_callbacks(timeout_sec=0.0)
                handler()
                handler.result()  # raises what the callback raised

    def _let_go(self) -> None:
        if self._kept is not None:
            self._kept.release()
            self._kept = None

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Let go of all entities; nothing is called any more."""
        self._let_go()
        return bool(super().shutdown(timeout_sec))


def _call_timer(timer: Any) -> None:
    try:
        with timer.handle:
            if not timer.handle.is_timer_ready():  # cancelled or reset by a callback before
                return
            timer.handle.call_timer()
    except InvalidHandle:  # destroyed by a callback before
        return
    timer.callback()


def _call_subscription(subscription: Subscription) -> None:
    try:
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    except InvalidHandle:  # destroyed by a callback before
        return
    if taken is None:
        return
    if subscription._callback_type is Subscription.CallbackType.MessageOnly:  # noqa: SLF001
        subscription.callback(taken[0])
    else:
        subscription.callback(*taken)
