"""Stamps of the samples of a bag: of the headers, or evened out from these or the log times."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ...core import FEET, ImuSeries, IntArray, RecordingError
from ...timing import even_stamps
from ..recording import Recording
from .options import STAMPS


def restamped(
    recording: Recording, logged: Mapping[str, IntArray], stamps: str
) -> tuple[Recording, str]:
    """Return the recording with the stamps asked for, one of ``STAMPS``, and what was done.

    ``logged`` are the log times (N,) ns of the samples of each foot.

    Raises
    ------
    RecordingError
        When ``stamps`` is unknown, or "header" or "index" and the headers have no stamps.
    TimingError
        When the times cannot be evened out.
    """
    if stamps not in STAMPS:
        raise RecordingError(f"stamps are '{stamps}'; allowed is one of {', '.join(STAMPS)}")
    if stamps == "header":
        _refuse_none(recording)
        return recording, ""
    parts, moved = list[str](), dict[str, ImuSeries]()
    for foot in FEET:
        series = recording.imu(foot)
        if series is None or not len(series):
            continue
        time_ns = logged[foot] if stamps == "log" else series.stamp_ns
        if stamps == "index":
            _refuse_none(recording)
        even = even_stamps(foot, time_ns)
        moved[foot] = replace(series, stamp_ns=even.stamp_ns)
        parts.append(
            f"{foot} every {1e-6 * even.interval_ns:.4f} ms ({even.missing} samples missing)"
        )
    source = "log times" if stamps == "log" else "stamps of the headers"
    feet = replace(recording, left=moved.get("left"), right=moved.get("right"))
    return feet, f"{source}, evened out: {', '.join(parts)}"


def _refuse_none(recording: Recording) -> None:
    """Refuse headers without stamps, as microcontrollers leave them: nothing could use the bag."""
    for foot in FEET:
        series = recording.imu(foot)
        if series is not None and len(series) > 1 and not np.ptp(series.stamp_ns):
            raise RecordingError(
                f"the headers of the {foot} foot have no stamps that grow (all {len(series)} are "
                f"{series.stamp_ns[0]} ns); take the times at which the messages were logged, "
                "with --stamps log"
            )
