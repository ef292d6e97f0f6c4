"""Recordings of sensors at rest: exports of single sensors, or bags."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..core import FEET, FORWARD_LEFT_UP, CalibrationError, ImuSeries
from ..recording import Topics, find_topics, read_bag
from ..recording.importers import ImportOptions, check_as_it_is, is_table, read_sensors
from .file import ANY

Named = tuple[str, ImuSeries]


def load_sources(
    paths: Sequence[Path],
    foot: str | None = None,
    *,
    axes: str = FORWARD_LEFT_UP,
    topics: Topics | None = None,
    tables: ImportOptions | None = None,
) -> dict[str, list[Named]]:
    """Return the recordings by sensor: "left", "right", or "sensor" where no foot is known.

    A table (.csv and the like) holds one sensor as a rule, that of ``foot``; a bag holds both, of
    which ``foot`` may choose one.  ``tables`` says how tables are to be read.  Without ``topics``
    those of a bag are found by their names.

    Raises
    ------
    CalibrationError
        When there is no such file, or nothing of the foot in it.
    RecordingError
        When a file cannot be read.
    """
    sources: dict[str, list[Named]] = {}
    for path in paths:
        if not path.exists():
            raise CalibrationError(f"there is no file '{path}'")
        for name, series in _load(
            path, foot, replace(tables or ImportOptions(), axes=axes), topics
        ):
            sources.setdefault(name, []).append((path.stem or str(path), series))
    if ANY in sources and len(sources) > 1:
        raise CalibrationError(
            "exports and bags are given together; say with --foot of which foot the exports are"
        )
    return sources


def _load(
    path: Path, foot: str | None, tables: ImportOptions, topics: Topics | None
) -> list[Named]:
    if is_table(path):
        sensors = read_sensors(path, tables, foot or "")
        named = {(foot or ANY) if name == "" else name: series for name, series in sensors.items()}
        return [item for item in named.items() if foot in (None, item[0])]
    check_as_it_is(tables, path)
    recording = read_bag(path, topics=topics or find_topics(path).topics)
    feet = FEET if foot is None else (foot,)
    held = [(name, series) for name in feet if (series := recording.imu(name)) is not None]
    if not any(len(series) for _, series in held):
        topic = recording.topics.of(feet[0]).samples
        present = ", ".join(recording.imu_topics) or "none"
        raise CalibrationError(
            f"'{path}' has no samples of {' or '.join(feet)} ('{topic}'); its sensor_msgs/Imu "
            f"topics are: {present}; name one with --left-topic or --right-topic"
        )
    return [(name, series) for name, series in held if len(series)]
