"""A recording in memory: samples of both feet, truth, reference, air pressure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple, Protocol

from ..core import FEET, ImuSeries, PoseSeries, PressureSeries
from .reference import Reference
from .topics import Topics


class Correction(Protocol):
    """A correction of the samples of one sensor, such as its calibration."""

    def apply(self, series: ImuSeries, /) -> ImuSeries:
        """Return the corrected samples."""


class ClockStep(NamedTuple):
    """A clock that was set during the recording.

    Attributes
    ----------
    feet : whose stamps stepped, "left", "right" or both
    at_ns : the last stamp before, as the recording has it now
    by_ns : how far it was set back; negative: ahead
    since_start_ns : from the first stamp of the recording to ``at_ns``
    truth_cut : whether the truth made another step, so that it ends there
    """

    feet: tuple[str, ...]
    at_ns: int
    by_ns: int
    since_start_ns: int
    truth_cut: bool = False


@dataclass(frozen=True)
class Recording:
    """The samples of both feet, and the truth and reference that came with them.

    Attributes
    ----------
    left, right : samples and stamps in the order in which they were recorded; None if missing
    left_truth, right_truth : true poses (velocity in the navigation frame), where there are any
    reference : floor markers and the like, where there are any
    pressure : air pressure of sensors worn on "left", "right", or on the body for "both"
    left_frame, right_frame : frame ids of the two sensors
    notes : further facts that travel with the bag (its source, the clock of its stamps ...)
    topics : the names of the topics that were read
    imu_topics : every topic of type sensor_msgs/Imu that the bag has
    cut : what of the bag could not be read, as a sentence; empty for a whole one
    clock_steps : where a clock was set and the stamps after it have been moved to follow on
    """

    left: ImuSeries | None = None
    right: ImuSeries | None = None
    left_truth: PoseSeries | None = None
    right_truth: PoseSeries | None = None
    reference: Reference | None = None
    pressure: Mapping[str, PressureSeries] = field(default_factory=dict)
    left_frame: str = "left_imu"
    right_frame: str = "right_imu"
    notes: Mapping[str, str] = field(default_factory=dict)
    topics: Topics = field(default_factory=Topics)
    imu_topics: tuple[str, ...] = ()
    cut: str = ""
    clock_steps: tuple[ClockStep, ...] = ()

    def imu(self, foot: str) -> ImuSeries | None:
        """Return the samples of ``foot``, "left" or "right"."""
        return self.left if foot == "left" else self.right

    def corrected(self, corrections: Mapping[str, Correction]) -> Recording:
        """Return the recording with the samples of the feet in ``corrections`` corrected."""
        series = {
            foot: correction.apply(samples)
            for foot, correction in corrections.items()
            if (samples := self.imu(foot)) is not None
        }
        return replace(self, **series)  # type: ignore[arg-type]

    def of_feet(self, feet: Sequence[str]) -> Recording:
        """Return the recording with the sensors of these feet only, and what they measured."""
        out = [foot for foot in FEET if foot not in feet]
        gone = {name: None for foot in out for name in (foot, f"{foot}_truth")}
        pressure = {worn: each for worn, each in self.pressure.items() if worn not in out}
        return replace(self, pressure=pressure, **gone)  # type: ignore[arg-type]

    def truth(self, foot: str) -> PoseSeries | None:
        """Return the true poses of ``foot``, "left" or "right"."""
        return self.left_truth if foot == "left" else self.right_truth

    def frame(self, foot: str) -> str:
        """Return the frame id of the sensor on ``foot``, "left" or "right"."""
        return self.left_frame if foot == "left" else self.right_frame
