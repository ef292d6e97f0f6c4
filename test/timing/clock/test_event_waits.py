"""Of many waits the few that bound a line are kept."""

import pytest

from dualfoot_ros.timing.clock.event_waits import EventWaits
from dualfoot_ros.timing.clock.line import Line

FLAT = Line(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
INTERVAL = 0.03


def kept(*delays, bin_s=0.5):
    waits = EventWaits(bin_s, 10)
    for k, delay in enumerate(delays):
        waits.add(0.01 * k, delay, INTERVAL, FLAT)
    return waits


def test_the_shortest_and_those_around_an_interval_are_kept():
    waits = kept(0.010, 0.002, 0.029, 0.025, 0.032, 0.055)
    assert waits.least[:, 1].tolist() == [0.002]
    assert waits.longest[:, 1].tolist() == pytest.approx([0.029, 0.032])


def test_whole_intervals_of_failed_events_are_taken_off_but_for_one():
    waits = kept(0.004, 5.0 * INTERVAL + 0.001, 2.0 * INTERVAL + 0.028)
    assert waits.longest[:, 1].tolist() == pytest.approx([0.028, INTERVAL + 0.001])


def test_every_bin_keeps_its_own_and_the_oldest_go():
    waits = EventWaits(0.5, 10)
    for k in range(100):
        waits.add(0.25 * k, 0.01, INTERVAL, FLAT)
    assert len(waits) == 10
    assert waits.least[0, 0] == pytest.approx(20.0)
    waits.clear()
    assert len(waits) == 0
    assert waits.longest.shape == (0, 2)
