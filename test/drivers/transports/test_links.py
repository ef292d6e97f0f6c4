"""Sources over real links: a pseudo-terminal, loopback from another process, files."""

import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack, suppress
from pathlib import Path

import pytest
from processes import PATIENCE_S

from dualfoot_ros.drivers import Source, State
from dualfoot_ros.drivers.transports.senders import MAX_SENDERS, Senders

from ..frames import PERIOD_US, frame, mcu, stream, truth, ximu3
from ..links import Collector, PluggedDevice, held, settle

DEVICE = Path(__file__).parents[1] / "device.py"
QUICK = "retry_first=0.01&retry_max=0.05"


@pytest.fixture
def device(tmp_path):
    if not sys.platform.startswith("linux"):
        pytest.skip("pseudo-terminals are used as on Linux")
    plugged = PluggedDevice(tmp_path / "ttyFOOT")
    yield plugged
    plugged.unplug()


def open_source(uri, collector, **options):
    return Source(uri, collector.take, on_state=collector.state, **options)


@pytest.mark.parametrize("name", ["mcu", "ximu3", "witmotion", "xbus", "vectornav"])
def test_a_serial_device_is_read_at_a_pseudo_terminal(device, name):
    device.plug()
    collector = Collector()
    with open_source(f"serial://{device.path}?baud=921600&format={name}", collector) as source:
        assert collector.wait_for_state(State.CONNECTED)
        for k in range(50):
            device.send(frame(name, k))
        assert collector.wait_for_samples(50)
    assert source.state is State.STOPPED
    assert collector.samples[-1].specific_force == pytest.approx(truth(49)[0], abs=1e-3)


def test_a_device_unplugged_and_back_twenty_times_comes_back_each_time_and_leaks_nothing(device):
    before = held()
    collector = Collector()
    with open_source(
        f"serial://{device.path}?baud=921600&format=mcu&{QUICK}", collector
    ) as source:
        assert collector.wait_for_state(State.WAITING)
        for turn in range(20):
            device.plug()
            assert collector.wait_for_state(State.CONNECTED), f"turn {turn}"
            device.send(mcu(10 * turn) + mcu(10 * turn + 1) + mcu(10 * turn + 2)[:9])
            assert collector.wait_for_samples(2 * turn + 2), f"turn {turn}"
            device.unplug()
            assert collector.wait_for_state(State.WAITING), f"turn {turn}"
    assert source.counters["opened"] == source.counters["lost_links"] == 20
    assert [sample.counter for sample in collector.samples] == [
        10 * turn + k for turn in range(20) for k in (0, 1)
    ]
    assert not source.decoder.counters["lost"]
    assert settle(before) == before


def test_a_port_that_is_absent_is_waited_for_and_the_reason_said(device):
    collector = Collector()
    with open_source(f"serial://{device.path}?format=mcu&{QUICK}", collector) as source:
        assert collector.wait_for_state(State.WAITING)
        assert str(device.path) in collector.states[-1][1]
        assert source.counters["not_opened"] >= 1
        device.plug()
        assert collector.wait_for_state(State.CONNECTED)


def test_two_sources_cannot_read_one_port(device):
    device.plug()
    first, second = Collector(), Collector()
    uri = f"serial://{device.path}?format=mcu&{QUICK}"
    with open_source(uri, first), open_source(uri, second):
        assert first.wait_for(lambda c: c.states[1:]) and second.wait_for(lambda c: c.states[1:])
        states = {first.states[1][0], second.states[1][0]}
    assert states == {State.CONNECTED, State.WAITING}


def run_device(*arguments):
    command = [sys.executable, DEVICE, *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


@pytest.mark.parametrize("name", ["mcu", "ximu3_ascii"])
def test_udp_from_another_process_keeps_the_devices_clock_and_adds_the_hosts(name):
    collector = Collector()
    before_ns = time.time_ns()
    with open_source(f"udp://:0?format={name.removesuffix('_ascii')}", collector) as source:
        assert collector.wait_for_state(State.CONNECTED)
        sender = run_device("udp", source.transport.port, name, 100, 3600, 1500)
        assert collector.wait_for_samples(100)
        assert sender.wait(PATIENCE_S) == 0
    sender.stdout.close()
    assert_clocks_are_kept_apart(collector.samples, before_ns)
    ((sender, count),) = source.senders.samples.items()
    assert sender.startswith("127.0.0.1:") and count == 100


def assert_clocks_are_kept_apart(samples, before_ns):
    arrivals = [sample.arrival_ns for sample in samples]
    assert before_ns <= arrivals[0] and arrivals[-1] <= time.time_ns()
    assert arrivals == sorted(arrivals)
    ticks = [sample.ticks for sample in samples]
    assert ticks == sorted(ticks)
    assert ticks[0] // 1_000_000 == 3600  # the device's clock is an hour off


def test_tcp_from_another_process_and_again_after_it_has_gone():
    server = run_device("tcp", 0, "mcu", 60)
    port = int(server.stdout.readline())
    collector = Collector()
    before_ns = time.time_ns()
    with open_source(f"tcp://127.0.0.1:{port}?format=mcu&{QUICK}", collector):
        assert collector.wait_for_samples(60)
        assert collector.wait_for_state(State.WAITING)
        assert_clocks_are_kept_apart(collector.samples, before_ns)
        again = run_device("tcp", port, "mcu", 60)
        assert collector.wait_for_samples(120)
    for process in (server, again):
        assert process.wait(PATIENCE_S) == 0
        process.stdout.close()


def test_a_tcp_server_that_falls_silent_is_connected_to_again(clock):
    collector = Collector()
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        uri = f"tcp://:{port}?format=mcu&silence=0.2&{QUICK}"
        with open_source(uri, collector):
            first, _ = server.accept()
            server.settimeout(0.1)
            second = None
            while second is None:
                clock.move_on(1.0)
                with suppress(TimeoutError):
                    second, _ = server.accept()
            second.sendall(mcu(0))
            assert collector.wait_for_samples(1)
    first.close()
    second.close()
    assert any("nothing came" in reason for _, reason in collector.states)


def test_a_udp_source_without_a_host_listens_to_this_machine_only():
    with open_source("udp://:0?format=mcu", Collector()) as source:
        assert source.transport.description == "UDP 127.0.0.1:0"


def test_datagrams_of_others_than_the_peers_are_counted_and_dropped():
    collector = Collector()
    uri = "udp://127.0.0.1:0?format=mcu&peers=127.0.0.2"
    with open_source(uri, collector) as source, socket.socket(type=socket.SOCK_DGRAM) as stranger:
        assert collector.wait_for_state(State.CONNECTED)
        target = ("127.0.0.1", source.transport.port)
        stranger.sendto(mcu(1), target)
        with socket.socket(type=socket.SOCK_DGRAM) as peer:
            peer.bind(("127.0.0.2", 0))
            peer.sendto(mcu(2), target)
            assert collector.wait_for_samples(1)
    assert [sample.counter for sample in collector.samples] == [2]
    assert source.counters["foreign"] == 1
    assert source.transport.strangers == {"127.0.0.1": 1}


@pytest.mark.parametrize("hosts", [("127.0.0.2", "127.0.0.3"), ("127.0.0.1", "127.0.0.1")])
def test_two_devices_on_one_udp_port_are_noticed(hosts):
    collector = Collector()
    with open_source("udp://127.0.0.1:0?format=ximu3", collector) as source, ExitStack() as open_:
        assert collector.wait_for_state(State.CONNECTED)
        out = [open_.enter_context(socket.socket(type=socket.SOCK_DGRAM)) for _ in hosts]
        for each, host in zip(out, hosts, strict=True):
            each.bind((host, 0))
        for k in range(6):
            out[k % 2].sendto(ximu3(k), ("127.0.0.1", source.transport.port))
        assert collector.wait_for_samples(6)
        names = {"{}:{}".format(*each.getsockname()) for each in out}
    assert source.senders.samples == dict.fromkeys(names, 3)
    assert source.senders.returns == dict.fromkeys(names, 2)


def test_a_device_that_starts_again_with_another_port_is_not_two():
    senders = Senders()
    for name in ("a:1", "a:1", "a:2", "a:2", "a:3"):
        senders.count(name, 1)
    assert set(senders.returns.values()) == {0}


def test_no_more_than_a_few_senders_are_kept():
    senders = Senders()
    for k in range(1000):
        senders.count(f"a:{k}", 1)
    assert (
        set(senders.samples)
        == set(senders.returns)
        == {f"a:{k}" for k in range(1000 - MAX_SENDERS, 1000)}
    )


def test_a_file_is_read_to_its_end(tmp_path):
    path = tmp_path / "walk.csv"
    path.write_bytes(stream("dot_csv", 500))
    collector = Collector()
    with open_source(f"file://{path}?speed=0", collector) as source:
        assert collector.wait_for_state(State.ENDED)
    assert len(collector.samples) == 500
    assert source.state is State.ENDED


def test_a_file_is_played_sample_by_sample_and_arrivals_are_those_of_now(tmp_path):
    path = tmp_path / "walk.bin"
    path.write_bytes(stream("mcu", 40))
    collector = Collector()
    before_ns = time.time_ns()
    with open_source(f"file://{path}?format=mcu&speed=10", collector):
        assert collector.wait_for_state(State.ENDED)
    arrivals = [sample.arrival_ns for sample in collector.samples]
    due = [before_ns + k * PERIOD_US * 1000 // 10 for k in range(40)]
    assert all(arrival >= moment for arrival, moment in zip(arrivals, due, strict=True))


def test_playing_a_file_stops_at_once_when_it_is_told_to(tmp_path):
    path = tmp_path / "walk.bin"
    path.write_bytes(stream("mcu", 5000))
    collector = Collector()
    source = open_source(f"file://{path}?format=mcu&speed=0.01", collector)
    source.start()
    assert collector.wait_for_samples(1)
    source.stop()
    assert source.state is State.STOPPED


def test_a_file_that_still_grows_is_followed(tmp_path):
    path = tmp_path / "walk.csv"
    path.write_bytes(stream("dot_csv", 3))
    collector = Collector()
    with open_source(f"file://{path}?speed=0&follow=true", collector):
        assert collector.wait_for_samples(3)
        with path.open("ab") as out:
            out.write(frame("dot_csv", 3))
        assert collector.wait_for_samples(4)


def test_no_sample_comes_after_stop_and_nothing_is_left_behind(device):
    device.plug()
    before = held()
    collector = Collector()
    source = open_source(f"serial://{device.path}?format=mcu", collector)
    source.start()
    assert collector.wait_for_state(State.CONNECTED)
    device.send(mcu(1))
    assert collector.wait_for_samples(1)
    source.stop()
    assert settle(before) == before
    device.send(mcu(2))
    assert len(collector.samples) == 1
    assert threading.main_thread() not in collector.threads


def test_a_source_can_be_started_again(device):
    device.plug()
    collector = Collector()
    source = open_source(f"serial://{device.path}?format=mcu", collector)
    for turn in range(3):
        with source:
            assert collector.wait_for_state(State.CONNECTED)
            device.send(mcu(turn))
            assert collector.wait_for_samples(turn + 1)
        assert source.state is State.STOPPED


def test_a_callback_that_raises_ends_the_source_and_is_said(tmp_path):
    path = tmp_path / "walk.bin"
    path.write_bytes(stream("mcu", 5))
    before = held()
    collector = Collector()

    def broken(samples):
        raise ZeroDivisionError("the user's own")

    with Source(f"file://{path}?format=mcu", broken, on_state=collector.state) as source:
        assert collector.wait_for_state(State.FAILED)
    assert isinstance(source.reader.failure, ZeroDivisionError)
    assert settle(before) == before
