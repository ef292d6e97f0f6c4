"""Choice of the topics of a bag: which of them has the samples of which foot."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from ..core import FEET, RecordingError
from .open_bag import list_topics
from .storage.bag_source import TopicInfo
from .topics import IMU_TYPE, VECTOR_TYPE, FootTopics, Topics

WORDS = {"left": ("left", "lft", "lf", "l"), "right": ("right", "rgt", "rf", "r")}
FOOT = re.compile(r"foot|feet|shoe|toe|heel|instep|ankle|boot")
PARTS = "hand|arm|forearm|wrist|elbow|wheel|thigh|shank|shin|knee|hip|head|ear|eye|motor"
ELSEWHERE = re.compile(rf"(left|right|l|r)?({PARTS})")
FORCE = re.compile(r"acc|specific_?force", re.IGNORECASE)
NO_FORCE = re.compile(r"free|linear", re.IGNORECASE)  # gravity is taken out
RATE = re.compile(r"gyr|angular|omega|rate_of_turn", re.IGNORECASE)


class TopicChoice(NamedTuple):
    """The topics of both feet, and a sentence for each that was found by its name."""

    topics: Topics
    sentences: tuple[str, ...] = ()


def find_topics(
    path: str | Path, left: str | None = None, right: str | None = None
) -> TopicChoice:
    """Return the topics of the bag ``path``; raise as :func:`choose_topics` and ``list_topics``.

    ``left`` and ``right`` name the topic of a foot, or two as ``ACCELEROMETER,GYRO``.
    """
    return choose_topics(list_topics(path), {"left": left, "right": right})


def choose_topics(
    present: Mapping[str, TopicInfo], given: Mapping[str, str | None]
) -> TopicChoice:
    """Return the topics that were ``given``, else the usual ones, else those with fitting names.

    A foot without any of these keeps the usual name.

    Raises
    ------
    RecordingError
        When several topics could be those of a foot; lists them.
    """
    usual_topics, found, sentences = Topics(), dict[str, FootTopics](), list[str]()
    for foot in FEET:
        usual = usual_topics.of(foot)
        name = given.get(foot)
        if name is not None:
            choice = named_topics(name, usual)
        elif usual.imu in present:
            choice = usual
        else:
            choice = _by_name(foot, usual, present)
            if choice is not usual:
                sentences.append(_describe(foot, choice))
        found[foot] = choice
    return TopicChoice(Topics(found["left"], found["right"]), tuple(sentences))


def named_topics(name: str, usual: FootTopics) -> FootTopics:
    """Return the topics ``TOPIC`` or ``ACCELEROMETER,GYRO`` of a foot.

    Raises
    ------
    RecordingError
        When there are more than two.
    """
    parts = [part.strip() for part in name.split(",") if part.strip()]
    if not 1 <= len(parts) <= 2:
        raise RecordingError(
            f"the topic is '{name}'; allowed is one name, or two as ACCELEROMETER,GYRO"
        )
    return replace(usual, imu=parts[-1], force=parts[0] if len(parts) == 2 else "")


def foot_of_topic(topic: str) -> str | None:
    """Return which foot the name of a topic speaks of; None for neither, both, or a hand."""
    words = {word.rstrip("0123456789") for word in re.split(r"[^a-z0-9]+", _words(topic))}
    if any(ELSEWHERE.fullmatch(word) for word in words):
        return None
    feet = [
        foot
        for foot, names in WORDS.items()
        if words & set(names) or any(foot in word for word in words)
    ]
    return feet[0] if len(feet) == 1 else None


def topics_of_foot(foot: str, topics: Iterable[str]) -> list[str]:
    """Return the topics whose names say ``foot``; where some say shoe or the like, only these."""
    own = sorted(topic for topic in topics if foot_of_topic(topic) == foot)
    return [topic for topic in own if FOOT.search(_words(topic))] or own


def _words(topic: str) -> str:
    """Return the name in lower case, with an underscore where camel case begins a word."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", topic).lower()


def _by_name(foot: str, usual: FootTopics, present: Mapping[str, TopicInfo]) -> FootTopics:
    own = {topic: present[topic] for topic in topics_of_foot(foot, present)}
    whole = [t for t, info in own.items() if info.msgtype == IMU_TYPE and not _is_half(t, own)]
    candidates = [replace(usual, imu=topic) for topic in sorted(whole)]
    candidates = candidates or [replace(usual, imu=r, force=f) for f, r in _pairs(own)]
    if len(candidates) > 1:
        names = " or ".join(candidate.samples for candidate in candidates)
        raise RecordingError(
            f"several topics could be those of the {foot} foot: name one with --{foot}-topic, "
            f"{names}"
        )
    return candidates[0] if candidates else usual


def _is_half(topic: str, own: Collection[str]) -> bool:
    """Return whether a topic is one of an accelerometer's and a gyro's, as of some cameras."""
    if FORCE.search(topic):
        return any(RATE.search(other) for other in own)
    return bool(RATE.search(topic)) and any(FORCE.search(other) for other in own)


def _pairs(own: Mapping[str, TopicInfo]) -> Iterator[tuple[str, str]]:
    """Yield topics of specific force and of angular rate that are of one type."""
    for force, (kind, _) in sorted(own.items()):
        if kind not in (IMU_TYPE, VECTOR_TYPE) or not FORCE.search(force):
            continue
        if NO_FORCE.search(force):
            continue
        for rate, info in sorted(own.items()):
            if info.msgtype == kind and RATE.search(rate):
                yield force, rate


def _describe(foot: str, choice: FootTopics) -> str:
    if choice.force:
        return (
            f"taking {choice.force} and {choice.imu} as {foot}, joined by their stamps, because "
            f"their names say {foot}"
        )
    return f"taking {choice.imu} as {foot} because its name says {foot}"
