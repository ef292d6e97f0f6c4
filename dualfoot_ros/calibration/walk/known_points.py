"""Loops and floor markers as a check of a calibration: before and after, never in the fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...core import TrackerConfig
from ...evaluation import Evaluation, evaluate, track
from ...recording import Recording
from ..sensor import SensorCalibration


@dataclass(frozen=True)
class WalkErrors:
    """Errors of one walk that its reference shows; None where it does not.

    Attributes
    ----------
    closure_percent : closing error of the point midway between the feet, percent of the distance
    height_m : of the mean of both feet, end less start of a closed loop
    marker_rmse_m : RMSE of the foot's stances on floor markers, mean over feet with markers
    """

    closure_percent: float | None
    height_m: float | None
    marker_rmse_m: float | None

    @property
    def known(self) -> bool:
        """Whether there is any."""
        return self.closure_percent is not None or self.marker_rmse_m is not None


@dataclass(frozen=True)
class BeforeAndAfter:
    """The errors of a walk as it is, and with a matrix that this walk had no part in."""

    before: WalkErrors
    after: WalkErrors


def walk_errors(
    recording: Recording, config: TrackerConfig, sensors: Mapping[str, SensorCalibration]
) -> WalkErrors:
    """Return the errors of a recording whose samples are corrected by ``sensors``."""
    corrected = recording.corrected(sensors)
    found = evaluate(track(corrected, config), reference=corrected.reference)
    reports = found.marker_report.values()
    rmses = [r.rmse_m for r in reports if r.rmse_m is not None]
    closed = found.closed_loop and found.closure is not None
    return WalkErrors(
        closure_percent=found.closure.midpoint_percent if closed and found.closure else None,
        height_m=height_m(found) if found.closed_loop else None,
        marker_rmse_m=sum(rmses) / len(rmses) if rmses else None,
    )


def height_m(found: Evaluation) -> float:
    """Return by how much the feet end above their start, m."""
    feet = found.tracked.left, found.tracked.right
    return sum(float(foot.position[-1, 2] - foot.position[0, 2]) for foot in feet) / len(feet)
