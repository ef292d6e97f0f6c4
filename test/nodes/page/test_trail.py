"""Trails: bounded memory, whatever the length of the walk."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import YawTurn
from dualfoot_ros.nodes.page.trail import Place, Trail, seconds

LEFT = YawTurn(math.pi / 2, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def straight(metres, step=0.1):
    return [Place(k * step, k * step, 0.0, 0.0) for k in range(round(metres / step) + 1)]


@given(st.integers(min_value=1, max_value=4000))
def test_a_trail_never_holds_more_than_it_may_and_keeps_start_and_length(count):
    trail = Trail(50, 0.1)
    for place in straight(0.1 * count, 0.1):
        trail.add(place)
    assert len(trail.places) <= 50
    assert trail.places[0] == Place(0.0, 0.0, 0.0, 0.0)
    assert trail.length <= 0.1 * count + 1e-9
    newest = trail.places[-1].x
    assert 0.1 * count - newest < max(0.21, 0.2 * count / 10)


def test_places_nearer_than_the_spacing_are_left_out():
    trail = Trail(100, 1.0)
    for place in straight(5.0):
        trail.add(place)
    assert [round(p.x, 6) for p in trail.places] == pytest.approx([0, 1, 2, 3, 4, 5], abs=0.11)


def test_a_trail_by_time_goes_on_while_a_person_stands():
    trail = Trail(100, 0.5, seconds)
    for k in range(21):
        trail.add(Place(0.1 * k, 0.0, 0.0, 1.0))
    assert len(trail.places) == 5


def test_what_cannot_be_drawn_is_left_out():
    trail = Trail(10, 0.0)
    trail.add(Place(0.0, math.nan, 0.0, 0.0))
    trail.add(Place(0.0, 0.0, math.inf, 0.0))
    assert trail.places == []


def test_a_turn_moves_every_place_and_is_another_edition():
    trail = Trail(10, 0.0)
    for place in straight(0.3):
        trail.add(place)
    before = trail.edition
    trail.turn(9.0, LEFT)
    assert trail.edition != before
    turned = np.array([p[1:] for p in trail.places])
    assert turned == pytest.approx(np.array([[0.0, 0.1 * k, 1.0] for k in range(4)]))


def test_new_places_are_the_same_edition_and_a_thinner_trail_is_another():
    trail = Trail(10, 0.1)
    editions = set()
    for k, place in enumerate(straight(1.0, 0.11)):
        trail.add(place)
        if k < 9:
            editions.add(trail.edition)
    assert len(editions) == 1


def test_what_was_walked_before_comes_in_front():
    trail = Trail(100, 0.0)
    walk = straight(1.0)
    for place in walk[6:]:
        trail.add(place)
    trail.seed(walk[:8], 0.8)
    assert trail.places == walk


def test_a_turn_is_the_same_in_whatever_order_the_messages_come():
    walk = straight(1.0)
    trails = []
    for when in (0, 5, 8, 11):
        trail = Trail(100, 0.0)
        for number, place in enumerate(walk):
            if number == when:
                trail.turn(0.45, LEFT)
            trail.add(place)
        if when == 11:
            trail.turn(0.45, LEFT)
        trails.append(np.array(trail.places))
    assert all(np.allclose(trails[0], other) for other in trails[1:])
    assert trails[0][:5, 1] == pytest.approx(np.zeros(5), abs=1e-12)
    assert trails[0][5:, 2] == pytest.approx(np.zeros(6))


def test_without_a_turn_what_was_published_before_is_dropped_and_does_not_count():
    trail = Trail(100, 0.0)
    walk = straight(1.0)
    for place in walk:
        trail.add(place)
    trail.turn(0.45, None)
    trail.add(walk[2])  # its message is late
    assert trail.places == walk[5:]
    assert trail.length == pytest.approx(0.5)


def test_a_place_that_was_published_after_a_turn_is_turned_already():
    trail = Trail(100, 0.0)
    trail.add(Place(1.0, 1.0, 0.0, 0.0), published=3.0)
    trail.turn(2.0, LEFT)
    assert trail.places == [Place(1.0, 1.0, 0.0, 0.0)]
