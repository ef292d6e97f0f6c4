"""``dualfoot evaluate --self-calibrate``: gyro matrices from the very walk that is evaluated."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..inspection import mend_clocks, require_usable
from .arguments import recording_name
from .printing import progress

if TYPE_CHECKING:
    from ..calibration import SensorCalibration
    from ..core import TrackerConfig
    from ..recording import Recording


def self_calibration(
    args: argparse.Namespace,
    recording: Recording,
    config: TrackerConfig,
    given: Mapping[str, SensorCalibration],
) -> tuple[dict[str, SensorCalibration], tuple[str, ...]]:
    """Return ``given`` with gyro matrices of the walk itself, and sentences that say so.

    Raises
    ------
    CalibrationError
        When the walk has too few steps.
    RecordingError
        When the samples cannot be used.
    """
    from ..calibration import calibrate_walks, weakest

    recording = mend_clocks(recording)
    require_usable(recording, allow_not_finite=args.allow_nan)
    with progress("calibrating") as update:
        result = calibrate_walks(
            [(Path(recording_name(args)).name, recording)], config, given, progress=update
        )
    known = ", ".join(
        f"{name} to {100 * weakest(foot.fit).std:.2f} % or better"
        for name, foot in result.feet.items()
    )
    notes = [
        f"gyro matrices from this walk itself ({known}), so its figures are not those of a walk "
        "that the calibration has not seen"
    ]
    notes += [f"{name}: {text}" for name, foot in result.feet.items() for text in foot.remarks()]
    return result.sensors(given), tuple(notes)
