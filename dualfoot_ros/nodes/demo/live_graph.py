"""Graph of the real nodes in this process, as fast as they go and without loss.

replay -> time_sync -> fusion (one for each method) -> collector.  Each takes its samples from
topics as any node does; only the speed is set by how far the slowest of them has come.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter

from ...core import FEET, DualFootError, TrackerConfig, Trajectory
from ..fusion import FusionNode
from ..inputs.field_topics import TOPICS as MAGNETIC
from ..inputs.increments_topics import TOPICS as KINDS
from ..inputs.pressure_topics import TOPICS
from ..replay import ReplayNode
from ..ros.executor import Executor
from ..ros.program import destroy
from ..time_sync import TimeSyncNode
from .collector import CollectorNode

AHEAD = 200  # samples that may be under way between two nodes
PATIENCE_S = 5.0  # without progress: the missing messages were lost
SPINS = 50  # between two checks of the progress
PATIENT = {"input.silence": 60.0, "input.latency": 0.0}
"""The nodes share one thread: while one compiles, no other is silent, and samples may wait."""

Progress = Callable[[float], None]


@dataclass(frozen=True)
class LiveRun:
    """Trajectory that one fusion node published, with the samples lost on the way.

    ``counters`` are those of its tracker.
    """

    trajectory: Trajectory
    lost: int
    counters: Mapping[str, int]


class LiveGraph:
    """Nodes of a run, and the messages that are under way between them."""

    def __init__(
        self, bag: Path, configs: Mapping[str, TrackerConfig], context: rclpy.Context
    ) -> None:
        self.context = context
        self._names = list(configs)
        # A number of its own keeps this graph apart from any other.
        self._space = f"dualfoot_{time.time_ns() % 10**9}"
        self._nodes: list[Node] = []
        try:
            self._build(bag, configs)
        except BaseException:
            destroy(self._nodes)
            raise

    def _build(self, bag: Path, configs: Mapping[str, TrackerConfig]) -> None:
        self.sync = self._add(TimeSyncNode, PATIENT, "")
        self.fusions, self.collectors = {}, {}
        for name, config in configs.items():
            space = f"/{name}"
            values = {**config.to_mapping(), **PATIENT, "sync": "external", "engine": "compiled"}
            self.fusions[name] = self._add(
                FusionNode, values, space, cli_args=_remap_inputs(self._space)
            )
            self.collectors[name] = self._add(CollectorNode, {}, space)
        values = {"bag": str(bag), "clock": False}
        self.replay = self._add(ReplayNode, values, "", gate=self._has_room)

    def _add(
        self, kind: Callable[..., Any], values: dict[str, Any], space: str, **options: Any
    ) -> Any:
        overrides = [Parameter(name, value=value) for name, value in values.items()]
        node = kind(
            context=self.context,
            namespace=f"/{self._space}{space}",
            parameter_overrides=overrides,
            **options,
        )
        self._nodes.append(node)
        return node

    def _under_way(self) -> list[int]:
        """Return how many samples wait between the nodes, a number a hop."""
        received = self.sync.streams.received
        counters = self.sync.streams.aligner.counters
        missing = sum(counters[f"{foot}_missing"] for foot in FEET)
        sent = len(FEET) * counters["pairs"] - missing
        pressures = self.replay.pressure.sent
        fields = sum(output.sent for output in self.replay.fields.values())
        waiting = [self.replay.player.played - pressures - fields - received]
        for name, fusion in self.fusions.items():
            collector = self.collectors[name].messages
            waiting.append(sent - fusion.streams.received)
            if fusion.pressure is not None:
                waiting.append(pressures - fusion.pressure.received)
            if fusion.fields is not None:
                waiting.append(fields - fusion.fields.received)
            waiting.append(fusion.outputs.messages - sum(map(len, collector.values())))
        return waiting

    def _has_room(self) -> bool:
        return self._know_kinds() and max(self._under_way()) < AHEAD

    def _know_kinds(self) -> bool:
        """Return whether every fusion node knows what the samples are, as far as the bag does."""
        known = {foot for foot, output in self.replay.increments.items() if output.kind}
        return all(known <= set(fusion.increments.declared) for fusion in self.fusions.values())

    def run(self, progress: Progress) -> None:
        """Spin until everything has arrived, or nothing has moved for a while.

        Raises
        ------
        DualFootError
            When the bag was not played to its end.
        """
        executor = Executor(context=self.context)
        try:
            for node in self._nodes:
                executor.add_node(node)
            self.replay.player.start()
            self._spin(executor, progress)
        finally:
            executor.shutdown()
        if not self.replay.done.done():
            raise DualFootError(
                f"the replay stopped after {self.replay.player.played} of "
                f"{self.replay.total} samples"
            )

    def _spin(self, executor: Executor, progress: Progress) -> None:
        state: tuple[int, ...] = ()
        since = time.monotonic()
        while time.monotonic() - since < PATIENCE_S:
            for _ in range(SPINS):
                executor.spin_once(timeout_sec=0.05)
                if self.replay.done.done() and not any(self._under_way()):
                    return
            progress(self.replay.player.played / self.replay.total)
            now = (self.replay.player.played, *self._under_way())
            if now != state:
                state, since = now, time.monotonic()

    def result(self, name: str) -> LiveRun:
        """Return what the fusion node of a method published."""
        fusion = self.fusions[name]
        method, counters = fusion.tracker.config.method, dict(fusion.tracker.counters)
        lost = self.sync.streams.lost + fusion.streams.lost
        lost += sum(max(0, waiting) for waiting in self._under_way())
        return LiveRun(self.collectors[name].trajectory(method, counters), lost, counters)

    def close(self) -> None:
        """Destroy the nodes."""
        destroy(self._nodes)


def run_live(
    bag: Path,
    configs: Mapping[str, TrackerConfig],
    context: rclpy.Context,
    progress: Progress = lambda share: None,
) -> dict[str, LiveRun]:
    """Replay ``bag`` through the nodes, one fusion node a configuration.

    Raises
    ------
    DualFootError
        When the bag cannot be read.
    """
    graph = LiveGraph(bag, configs, context)
    try:
        graph.run(progress)
        return {name: graph.result(name) for name in configs}
    finally:
        graph.close()


def same_bits(live: Trajectory, batch: Trajectory) -> bool:
    """Return whether two runs agree to the bit in everything that is published unchanged."""
    pairs = [(live.left, batch.left), (live.right, batch.right)]
    fields = ("stamp_ns", "position", "quaternion", "position_covariance", "attitude_covariance")
    return all(
        np.array_equal(getattr(a, field), getattr(b, field)) for a, b in pairs for field in fields
    )


def _remap_inputs(space: str) -> list[str]:
    names = [*(f"{foot}/imu/data_sync" for foot in FEET), *KINDS.values()]
    names += [*TOPICS.values(), *MAGNETIC.values()]
    remaps = [f"{name}:=/{space}/{name}" for name in names]
    return ["--ros-args", *(word for remap in remaps for word in ("-r", remap))]
