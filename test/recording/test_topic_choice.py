"""Topics of the feet: the usual ones, those that are named, those whose names say a foot."""

import pytest

from dualfoot_ros.core import RecordingError
from dualfoot_ros.recording import TopicInfo, choose_topics
from dualfoot_ros.recording.topic_choice import foot_of_topic
from dualfoot_ros.recording.topics import IMU_TYPE, VECTOR_TYPE

NOTHING = {"left": None, "right": None}


def bag(*imu, vector=()):
    """Return the topics of a bag, ``imu`` and ``vector`` by type."""
    types = {**dict.fromkeys(imu, IMU_TYPE), **dict.fromkeys(vector, VECTOR_TYPE)}
    return {topic: TopicInfo(msgtype, 10) for topic, msgtype in types.items()}


@pytest.mark.parametrize(
    ("topic", "foot"),
    [
        ("/imu_left/data", "left"),
        ("/right/imu", "right"),
        ("/leftFoot/imu", "left"),
        ("/imu_l", "left"),
        ("/imuR/data", "right"),
        ("/dot/rf1/imu", "right"),
        ("/imu/data", None),
        ("/left/right_imu", None),
        ("/camera/imu_color", None),
        ("/rtk/imu", None),
        ("/left_hand/imu", None),
        ("/right_wheel/imu", None),
        ("/lefthand/imu", None),
        ("/imu_left/header_linear", "left"),
    ],
)
def test_a_name_says_a_foot_by_a_word_of_its_own(topic, foot):
    assert foot_of_topic(topic) == foot


def test_the_usual_topics_are_taken_without_a_word():
    choice = choose_topics(bag("/left/imu/data_raw", "/right/imu/data_raw", "/imu_left"), NOTHING)
    assert choice.topics.left.imu == "/left/imu/data_raw"
    assert choice.sentences == ()


def test_topics_with_fitting_names_are_taken_and_said():
    choice = choose_topics(bag("/imu_left/data", "/imu_right/data", "/body/imu"), NOTHING)
    assert (choice.topics.left.imu, choice.topics.right.imu) == (
        "/imu_left/data",
        "/imu_right/data",
    )
    assert choice.sentences[0] == "taking /imu_left/data as left because its name says left"


def test_two_candidates_are_listed_and_asked_for_by_name():
    topics = bag("/left/imu/data", "/left/imu/filtered", "/right/imu/data")
    with pytest.raises(RecordingError, match="--left-topic, /left/imu/data or /left/imu/filtered"):
        choose_topics(topics, NOTHING)
    choice = choose_topics(topics, {"left": "/left/imu/data", "right": None})
    assert choice.topics.left.imu == "/left/imu/data"
    assert choice.topics.right.imu == "/right/imu/data"


def test_a_foot_that_no_name_speaks_of_keeps_the_usual_topic():
    choice = choose_topics(bag("/imu_a", "/imu_b"), NOTHING)
    assert choice.topics.left.imu == "/left/imu/data_raw"


def test_an_accelerometer_and_a_gyro_on_two_topics_are_a_pair():
    names = ("/left/imu/acceleration", "/left/imu/angular_velocity", "/left/free_acceleration")
    choice = choose_topics(bag("/right/imu", vector=names), NOTHING)
    assert choice.topics.left.force == names[0]
    assert choice.topics.left.imu == names[1]
    assert f"taking {names[0]} and {names[1]} as left" in choice.sentences[0]


def test_halves_of_type_imu_are_a_pair_and_not_two_candidates():
    choice = choose_topics(bag("/cam_left/accel/sample", "/cam_left/gyro/sample"), NOTHING)
    assert choice.topics.left.samples == "/cam_left/accel/sample,/cam_left/gyro/sample"


def test_a_pair_is_named_with_a_comma_and_three_are_refused():
    choice = choose_topics({}, {"left": "/a,/g", "right": None})
    assert (choice.topics.left.force, choice.topics.left.imu) == ("/a", "/g")
    with pytest.raises(RecordingError, match="ACCELEROMETER,GYRO"):
        choose_topics({}, {"left": "/a,/b,/c", "right": None})


def test_a_name_that_says_foot_wins_over_one_that_only_says_the_side():
    choice = choose_topics(bag("/left/imu", "/left_foot/imu", "/rightShoe/imu"), NOTHING)
    assert choice.topics.left.imu == "/left_foot/imu"
    assert choice.topics.right.imu == "/rightShoe/imu"
