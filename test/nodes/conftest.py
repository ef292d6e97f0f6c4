"""A context of its own for each test, a domain of its own for each worker, loopback only."""

import fcntl
import importlib
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TextIO

import pytest
from processes import PATIENCE_S, default_signals, environment


def free_domain() -> tuple[int, TextIO]:
    """Return a domain that no other run of these tests uses, as long as the file is open."""
    for number in range(1, 102):
        with suppress(OSError):  # it is another's, or locked
            file = (Path(tempfile.gettempdir()) / f"dualfoot_ros_domain_{number}").open("w")
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return number, file
    raise RuntimeError("all domains of ROS are in use")


DOMAIN, LOCK = free_domain()
os.environ["ROS_DOMAIN_ID"] = str(DOMAIN)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.setdefault("ROS_HOME", "/tmp/dualfoot_ros_test")

if importlib.util.find_spec("rclpy") is None:
    collect_ignore_glob = ["test_*.py"]


class Bench:
    """Nodes of one test on one executor."""

    def __init__(self, context):
        from dualfoot_ros.nodes.ros.executor import Executor

        self.context = context
        self._executor = Executor(context=context)
        self._nodes = []

    def add(self, kind, values=None, **options):
        """Make a node with parameters and spin it along."""
        from rclpy.parameter import Parameter

        # A busy machine may be slower than the samples of a test.
        values = {"input.latency": 0.0, **(values or {})}
        overrides = [Parameter(name, value=value) for name, value in values.items()]
        node = kind(context=self.context, parameter_overrides=overrides, **options)
        self._nodes.append(node)
        self._executor.add_node(node)
        return node

    def plain(self, name="probe"):
        """Make a node without anything."""
        from rclpy.node import Node

        return self.add(lambda **options: Node(name, **options))

    def until(self, condition: Callable[[], object], said: str = ""):
        """Spin until ``condition`` holds; fail when it takes too long."""
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < deadline, f"waited in vain: {said}"
            self._executor.spin_once(timeout_sec=0.02)

    @staticmethod
    def set_now(node, now_ns: int) -> None:
        """Set the clock of a node that has ``use_sim_time``: what arrives has that time."""
        from rclpy.clock import ClockType
        from rclpy.time import Time

        now = Time(nanoseconds=now_ns, clock_type=ClockType.ROS_TIME)
        node.get_clock().set_ros_time_override(now)

    def close(self):
        self._executor.shutdown()
        for node in reversed(self._nodes):
            node.destroy_node()


@pytest.fixture(scope="session", autouse=True)
def patient_demo() -> Iterator[None]:
    """Let a run through the nodes that nothing is lost of take as long as the machine needs."""
    from dualfoot_ros.nodes.demo import live_graph

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(live_graph, "PATIENCE_S", PATIENCE_S)
        yield


@contextmanager
def new_context() -> Iterator:
    """Give an initialised context of rclpy."""
    import rclpy

    made = rclpy.Context()
    rclpy.init(args=[], context=made)
    # An --log-level that another test has given holds for the whole process.
    rclpy.logging.set_logger_level("", rclpy.logging.LoggingSeverity.INFO)
    try:
        yield made
    finally:
        rclpy.try_shutdown(context=made)


@contextmanager
def new_bench() -> Iterator[Bench]:
    """Give nodes on an executor, and end them."""
    with new_context() as context:
        made = Bench(context)
        try:
            yield made
        finally:
            made.close()


@pytest.fixture
def context() -> Iterator:
    """Return an initialised context of rclpy."""
    with new_context() as made:
        yield made


@pytest.fixture
def bench(context) -> Iterator[Bench]:
    """Return nodes on an executor."""
    made = Bench(context)
    yield made
    made.close()


@pytest.fixture(scope="session")
def passing_bench() -> Callable[[], AbstractContextManager[Bench]]:
    """Return what makes nodes on an executor for a fixture that keeps what they have said."""
    return new_bench


@pytest.fixture(scope="session")
def walk_bag(tmp_path_factory) -> Path:
    """Return a bag of a short simulated walk with truth; the feet are sampled at equal times."""
    from dualfoot_ros.recording import Recording, write_bag
    from dualfoot_ros.simulation import WalkConfig, simulate

    made = simulate(WalkConfig(route="straight", rate=60.0, standing=3.0), seed=1)
    path = tmp_path_factory.mktemp("bags") / "walk"
    recording = Recording(made.left, made.right, made.left_truth, made.right_truth)
    return write_bag(path, recording)


@pytest.fixture(scope="session")
def short_bag(walk_bag, tmp_path_factory) -> Path:
    """Return the first 12 s of the walk, with truth."""
    from dualfoot_ros.recording import read_bag, write_bag

    whole = read_bag(walk_bag)
    cut = replace(whole, left=whole.left[:720], right=whole.right[:720])
    return write_bag(tmp_path_factory.mktemp("bags") / "short", cut)


class Program:
    """An executable of the package as a process."""

    def __init__(self, module: str, *arguments: object):
        with default_signals():
            self._process = subprocess.Popen(
                [sys.executable, "-m", f"dualfoot_ros.nodes.{module}", *map(str, arguments)],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                env=environment(),
            )
        self._lines: list[str] = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self._process.stdout is not None
        self._lines.extend(self._process.stdout)

    @property
    def output(self) -> str:
        """What the process has printed so far."""
        return "".join(self._lines)

    def wait_for(self, text: str) -> None:
        """Wait until the process has printed ``text``."""
        deadline = time.monotonic() + PATIENCE_S
        while text not in self.output:
            assert time.monotonic() < deadline, f"'{text}' was not said:\n{self.output}"
            assert self._process.poll() is None or text in self._after_end(), self.output
            time.sleep(0.02)

    def _after_end(self) -> str:
        self._reader.join()
        return self.output

    def send(self, number: signal.Signals) -> None:
        """Send a signal."""
        self._process.send_signal(number)

    def code(self) -> int:
        """Wait for the end and return the exit code."""
        code = self._process.wait(timeout=PATIENCE_S)
        self._reader.join()
        return code

    def kill(self) -> None:
        """End it whatever it does."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()


@pytest.fixture
def program() -> Iterator[Callable[..., Program]]:
    """Start executables; whatever still runs after the test is ended."""
    started: list[Program] = []

    def start(module: str, *arguments: object) -> Program:
        started.append(Program(module, *arguments))
        return started[-1]

    yield start
    for each in started:
        each.kill()


class Refusal:
    """What a program ended with that was run in this process."""

    def __init__(self, code: int, output: str):
        self._code, self.output = code, output

    def code(self) -> int:
        """Return the exit code."""
        return self._code


@pytest.fixture
def program_here(monkeypatch, capfd) -> Callable[..., Refusal]:
    """Run an executable in this process, which has imported everything: it must end by itself."""

    def run(module: str, *arguments: object) -> Refusal:
        main = importlib.import_module(f"dualfoot_ros.nodes.{module}").main
        monkeypatch.setattr(sys, "argv", [module, *map(str, arguments)])
        with default_signals():  # the program ignores them at its end
            try:
                code = main()
            except SystemExit as end:  # --help, and what argparse refuses
                code = int(end.code or 0)
        return Refusal(code, "".join(capfd.readouterr()))

    return run
