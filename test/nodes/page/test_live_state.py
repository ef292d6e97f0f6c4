"""State of the page: a reader who follows has the same as one who has just come."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import YawTurn
from dualfoot_ros.nodes.page.live_state import PERSON, LiveState
from dualfoot_ros.nodes.page.trail import Place

ACTIONS = st.lists(st.sampled_from(["walk", "walk", "read", "turn", "clear"]), max_size=40)


class Reader:
    """What live.js does with the messages."""

    def __init__(self):
        self.cursor, self.trails = {}, {}

    def read(self, state):
        message, self.cursor = state.message(self.cursor)
        for name, new in message["trails"].items():
            self.trails[name] = self.trails.get(name, [])[: new["first"]] + new["places"]
        return message


@given(ACTIONS)
def test_a_reader_who_follows_has_what_a_new_one_gets(actions):
    state, follower, x = LiveState(), Reader(), 0.0
    for action in actions:
        if action == "walk":
            x += 1.0
            state.add((PERSON, "left"), Place(x, x, 0.0, 0.0))
        elif action == "turn":
            state.turn((PERSON,), x, YawTurn(0.1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
        elif action == "clear":
            state.clear()
        else:
            follower.read(state)
    follower.read(state)
    fresh = Reader()
    fresh.read(state)
    assert follower.trails == fresh.trails


def test_a_reader_who_has_all_is_sent_no_place_again():
    state, reader = LiveState(), Reader()
    state.add((PERSON,), Place(0.0, 0.0, 0.0, 0.0))
    assert reader.read(state)["trails"]
    assert reader.read(state)["trails"] == {}


def test_readers_do_not_disturb_each_other():
    state, one, other = LiveState(), Reader(), Reader()
    one.read(state)
    state.add((PERSON,), Place(0.0, 0.0, 0.0, 0.0))
    one.read(state)
    other.read(state)
    assert one.trails == other.trails


def test_the_message_is_json_and_has_the_way_walked():
    state = LiveState()
    for k in range(11):
        state.add((PERSON,), Place(float(k), 0.3 * k, 0.0, 0.0))
    state.show(phase="walking")
    message = json.loads(json.dumps(state.message({})[0], allow_nan=False))
    assert message["now"]["walked"] == pytest.approx(3.0)
    assert message["now"]["phase"] == "walking"


def test_a_walk_of_a_day_fits_into_a_message_of_some_kilobytes():
    state = LiveState()
    for k in range(20_000):
        state.add(state.trails, Place(float(k), 0.8 * k, 100.0, -3.0))
    assert len(json.dumps(state.message({})[0])) < 250_000
