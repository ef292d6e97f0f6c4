import threading

import numpy as np
import pytest
from processes import PATIENCE_S

from dualfoot_ros.core.samples.series import ImuSeries
from dualfoot_ros.nodes.playback.player import Player, in_order
from dualfoot_ros.settings.nodes import PlayConfig

FAST = PlayConfig(rate=1000.0, wait=0.0)


def series(stamps):
    stamps = np.array(stamps, dtype=np.int64)
    values = np.column_stack([stamps, stamps, stamps]).astype(float)
    return ImuSeries(stamps, values, -values)


def played(player):
    player.start()
    assert player.join(PATIENCE_S)


def test_samples_of_both_feet_come_in_the_order_of_their_time():
    found = list(in_order({"left": series([0, 20, 40]), "right": series([10, 20, 30])}))
    assert [(s.foot, s.stamp_ns) for s in found] == [
        ("left", 0), ("right", 10), ("left", 20), ("right", 20), ("right", 30), ("left", 40),
    ]  # fmt: skip
    np.testing.assert_array_equal(found[1].values, [10, 10, 10, -10, -10, -10])


def test_a_late_sample_stays_where_it_was_recorded():
    found = list(in_order({"left": series([0, 30, 20, 40]), "right": series([25])}))
    assert [s.stamp_ns for s in found] == [0, 25, 30, 20, 40]
    assert [s.due_ns for s in found] == [0, 25, 30, 30, 40]


def test_everything_is_played_once_and_the_end_is_told():
    got, over = [], threading.Event()
    samples = {"left": series(range(0, 50, 10))}
    player = Player(lambda: in_order(samples), got.append, FAST, finished=over.set)
    played(player)
    assert [s.stamp_ns for s in got] == [0, 10, 20, 30, 40] and over.is_set()
    assert player.played == 5


def test_a_gate_holds_back_the_next_sample():
    got, tickets, shut = [], [True] * 3, threading.Event()
    samples = {"left": series(range(0, 100, 10))}

    def gate():
        if not tickets:
            shut.set()
        return bool(tickets) and tickets.pop()

    player = Player(lambda: in_order(samples), got.append, FAST, gate=gate)
    player.start()
    assert shut.wait(PATIENCE_S)
    player.stop()
    assert len(got) == 3


def test_a_loop_goes_on_until_it_is_stopped():
    enough = threading.Event()
    got = []

    def publish(sample):
        got.append(sample.stamp_ns)
        if len(got) > 25:
            enough.set()

    samples = {"left": series(range(0, 50, 10))}
    player = Player(
        lambda: in_order(samples), publish, PlayConfig(rate=1000.0, wait=0.0, loop=True)
    )
    player.start()
    assert enough.wait(PATIENCE_S)
    player.stop()
    assert got[:6] == [0, 10, 20, 30, 40, 0]


def test_nothing_is_played_before_somebody_listens():
    listening, got = threading.Event(), []
    samples = {"left": series([0, 10])}
    player = Player(
        lambda: in_order(samples),
        got.append,
        PlayConfig(rate=1000.0, wait=3600.0),
        ready=listening.is_set,
    )
    player.start()
    assert got == []
    listening.set()
    assert player.join(PATIENCE_S)
    assert len(got) == 2


def test_a_publisher_that_fails_because_ros_has_ended_ends_the_thread_quietly():
    def publish(_):
        raise RuntimeError("publisher's context is invalid")

    seen = []
    before, threading.excepthook = threading.excepthook, seen.append
    try:
        samples = {"left": series([0, 10])}
        played(Player(lambda: in_order(samples), publish, FAST, alive=lambda: False))
        assert seen == []
        played(Player(lambda: in_order(samples), publish, FAST, alive=lambda: True))
        assert len(seen) == 1
    finally:
        threading.excepthook = before


@pytest.mark.parametrize("rate", [0.5, 2.0])
def test_the_rate_scales_the_time_between_samples(rate, monkeypatch):
    now, naps = [0.0], []

    class Stop(threading.Event):
        def wait(self, timeout=None):
            naps.append(timeout)
            now[0] += timeout or 0.0
            return False

    monkeypatch.setattr("dualfoot_ros.nodes.playback.player.time.monotonic", lambda: now[0])
    samples = {"left": series([0, 1_000_000_000, 3_000_000_000])}
    player = Player(lambda: in_order(samples), lambda s: None, PlayConfig(rate=rate, wait=0.0))
    player._stop = Stop()
    player._play_once()
    assert sum(naps) == pytest.approx(3.0 / rate)
