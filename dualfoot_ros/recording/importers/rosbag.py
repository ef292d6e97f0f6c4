"""A bag of two sensor_msgs/Imu topics of any names, axes and units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...core import (
    FEET,
    FORCE_UNITS,
    RATE_UNITS,
    FloatArray,
    ImuSeries,
    RecordingError,
    axes_matrix,
)
from ..read import read_logged
from ..recording import Recording
from ..topic_choice import find_topics
from ..topics import Topics
from .bag_stamps import restamped
from .options import ImportOptions
from .twins import without_twins


def load(options: ImportOptions) -> Recording:
    """Load the one bag of ``options``, with its truth and reference, into SI and body axes.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When it is no bag, a unit is unknown, a topic is not there, both hold the same samples, or
        the headers have no stamps.
    """
    if len(options.sources) != 1 or options.left or options.right:
        raise RecordingError("a bag holds both feet; give exactly one, without --left and --right")
    rotation = np.array(axes_matrix(options.axes))
    force_unit, rate_unit = options.force_unit or "m/s^2", options.rate_unit or "rad/s"
    force = _scale("force unit", force_unit, FORCE_UNITS)
    rate = _scale("rate unit", rate_unit, RATE_UNITS)
    choice = find_topics(options.sources[0], options.left_topic, options.right_topic)
    recording, logged = read_logged(options.sources[0], topics=choice.topics)
    _check_topics(options.sources[0], recording)
    recording, stamping = restamped(recording, logged, options.stamps)
    notes = {
        **recording.notes,
        **({"topics": "; ".join(choice.sentences)} if choice.sentences else {}),
        **({"stamps": stamping} if stamping else {}),
        "source": options.sources[0].name,
        "format": "rosbag",
        "axes": f"forward, left, up were {options.axes}",
        "units": f"specific force was {force_unit}, angular rate {rate_unit}",
    }
    return without_twins(
        replace(
            recording,
            left=_turned(recording.left, rotation, force, rate),
            right=_turned(recording.right, rotation, force, rate),
            notes=notes,
            topics=Topics(),
        )
    )


def _check_topics(path: Path, recording: Recording) -> None:
    missing = [recording.topics.of(f).samples for f in FEET if recording.imu(f) is None]
    if missing:
        present = ", ".join(recording.imu_topics) or "none"
        raise RecordingError(
            f"'{path}' has no topic '{missing[0]}'; its sensor_msgs/Imu topics are: {present}; "
            "name two of them with --left-topic and --right-topic (or an accelerometer's and a "
            "gyro's, as ACCELEROMETER,GYRO)"
        )


def _scale(what: str, unit: str, known: Mapping[str, float]) -> float:
    if unit not in known:
        raise RecordingError(f"{what} is '{unit}'; allowed is one of {', '.join(known)}")
    return known[unit]


def _turned(
    series: ImuSeries | None, rotation: FloatArray, force: float, rate: float
) -> ImuSeries | None:
    if series is None:
        return None
    field = series.magnetic_field
    return replace(
        series,
        specific_force=series.specific_force @ rotation.T * force,
        angular_rate=series.angular_rate @ rotation.T * rate,
        magnetic_field=None if field is None else field @ rotation.T,
    )
