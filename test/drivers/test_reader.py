"""The reading thread on a scripted transport: how it waits, closes, and says what happens."""

from collections import Counter

import pytest
from processes import PATIENCE_S

from dualfoot_ros.drivers import BackoffConfig, Reader, State

BACKOFF = BackoffConfig(retry_first=0.1, retry_max=0.5)


class Script:
    """Plays sessions: each a list of what ``read`` gives; an OSError is raised, also by open."""

    description = "script"
    silence_s = 0.0

    def __init__(self, *sessions, reopens=True):
        self.sessions = list(sessions)
        self.reopens = reopens
        self.counters = Counter()
        self.log = []
        self.now = []

    def open(self):
        self.log.append("open")
        self.now = list(self.sessions.pop(0)) if self.sessions else [None]
        if isinstance(self.now[0], str):
            raise OSError(self.now[0])

    def read(self):
        item = self.now.pop(0)
        if isinstance(item, OSError):
            raise item
        return item

    def close(self):
        self.log.append("close")


class Clockless:
    """Stands in for the event that stops a reader: notes how long it would have waited."""

    def __init__(self):
        self.waits = []
        self.stopped = False

    def is_set(self):
        return self.stopped

    def wait(self, seconds):
        self.waits.append(seconds)
        return self.stopped

    def set(self):
        self.stopped = True

    def clear(self):
        self.stopped = False


def run(script):
    """Play a script to its end; return the reader, what came and what was said."""
    came, said = [], []
    reader = Reader(
        script,
        lambda data, arrival_ns: came.append((data, arrival_ns)),
        lambda state, reason: said.append((state, reason)),
        BACKOFF,
        clock=lambda: 42,
    )
    reader.stopping = Clockless()
    reader.start()
    reader._thread.join(PATIENCE_S)
    assert not reader._thread.is_alive()
    return reader, came, said


def test_what_is_read_is_handed_on_with_the_time_of_arrival():
    reader, came, _ = run(Script([b"ab", b"", b"c", None]))
    assert came == [(b"ab", 42), (b"c", 42)]
    assert reader.counters["received_bytes"] == 3


def test_waits_double_up_to_the_longest_while_a_device_is_absent():
    reader, _, _ = run(Script(*[["absent"]] * 5))
    assert reader.stopping.waits == pytest.approx([0.1, 0.2, 0.4, 0.5, 0.5])
    assert reader.counters["not_opened"] == 5


def test_waits_start_anew_after_a_link_that_brought_something():
    lost = OSError("gone")
    reader, _, _ = run(Script(["absent"], ["absent"], [b"x", lost], [b"y", lost]))
    assert reader.stopping.waits == pytest.approx([0.1, 0.2, 0.1, 0.1])


def test_waits_go_on_growing_for_a_link_that_opens_and_brings_nothing():
    reader, _, _ = run(Script(*[[OSError("gone")]] * 4))
    assert reader.stopping.waits == pytest.approx([0.1, 0.2, 0.4, 0.5])
    assert reader.counters["lost_links"] == 4


def test_a_transport_is_closed_after_every_try_also_a_vain_one():
    script = Script(["absent"], [b"x", OSError("gone")], ["absent"], [None])
    run(script)
    assert script.log == ["open", "close"] * 4


def test_a_reason_is_said_once_as_long_as_it_stays_the_same():
    _, _, said = run(Script(["absent"], ["absent"], ["busy"], [b"x", OSError("gone")]))
    assert said == [
        (State.CONNECTING, ""),
        (State.WAITING, "absent"),
        (State.WAITING, "busy"),
        (State.CONNECTED, ""),
        (State.WAITING, "gone"),
        (State.CONNECTED, ""),
        (State.ENDED, ""),
    ]


@pytest.mark.parametrize("session", [["no right to read"], [OSError("no right to read")]])
def test_a_file_that_cannot_be_read_is_not_tried_again(session):
    script = Script(session, reopens=False)
    reader, _, said = run(script)
    assert script.log == ["open", "close"]
    assert reader.state is State.FAILED
    assert said[-1] == (State.FAILED, "OSError: no right to read")


def test_a_transport_is_closed_even_when_opening_it_fails_in_an_unheard_of_way():
    script = Script([None])
    script.sessions = None
    script.open = lambda: script.log.append("open") or script.sessions[0]  # a TypeError
    reader, _, _ = run(script)
    assert script.log == ["open", "close"]
    assert reader.state is State.FAILED
    assert isinstance(reader.failure, TypeError)


def test_a_reader_that_never_ran_can_be_stopped():
    reader = Reader(Script(), lambda data, arrival_ns: None)
    reader.stop()
    assert reader.state is State.STOPPED
