import numpy as np

from dualfoot_ros.core import Details, Reason, YawTurn
from dualfoot_ros.core.results.events import Event, EventKind
from dualfoot_ros.nodes.results import event_messages as events

CONSTRAINT = Event(
    EventKind.CONSTRAINT,
    1_700_000_000_123_456_789,
    "left",
    1_700_000_000_223_456_789,
    np.array([0.1 + 0.2]),
    np.array([[1.0 / 3.0]]),
    np.pi,
    False,
    Details({"distance": np.float64(0.1), "shift": np.array([1.0, 1e-300, -0.0])}),
    Reason.NO_UNCERTAINTY,
)


def test_an_event_is_read_back_to_the_bit():
    (found,) = events.from_message(events.to_message((CONSTRAINT,), 5))
    assert (found.kind, found.stamp_ns, found.foot) == ("constraint", CONSTRAINT.stamp_ns, "left")
    assert found.detected_ns == CONSTRAINT.detected_ns and not found.accepted
    np.testing.assert_array_equal(found.innovation, CONSTRAINT.innovation)
    np.testing.assert_array_equal(found.S, CONSTRAINT.S)
    assert found.nis == CONSTRAINT.nis
    assert found.detail == {
        "distance": 0.1,
        "reason": "no uncertainty",
        "shift": [1.0, 1e-300, -0.0],
    }


def test_a_turn_is_read_back_as_a_turn_to_the_bit():
    turn = YawTurn(1.0 / 3.0, (0.1, 0.2, 0.0), (1e-300, -0.0, 7.0), True)
    event = Event(EventKind.HEADING, 1, "right", 2, payload=turn)
    (found,) = events.from_message(events.to_message((event,), 2))
    assert found.turn == turn


def test_an_event_without_measurement_is_read_back_too():
    event = Event(EventKind.STANCE_END, 1, "right", 2)
    (found,) = events.from_message(events.to_message((event,), 2))
    assert len(found.innovation) == 0 and np.isnan(found.nis)


def test_words_name_what_happened_and_that_it_was_refused():
    said = events.summarise(CONSTRAINT)
    assert said.startswith("constraint of left (refused)") and "distance 0.1" in said
