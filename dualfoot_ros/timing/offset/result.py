"""The relation of two clocks as a straight line, and moving stamps by it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ...core import ImuSeries, IntArray

DOUBT = 0.5  # confidence below which the result is called doubtful


@dataclass(frozen=True)
class Offset:
    """What brings the stamps of one clock (the right foot's) to another (the left foot's).

    Attributes
    ----------
    method : "motion", "shake" or "arrival"
    offset_ns : to be added to a stamp at ``center_ns``, ns
    center_ns : stamp of the moved clock at which ``offset_ns`` holds
    skew_ppm : how much faster the moved clock runs
    skew_known : False when the recording is too short to tell, and the skew is taken as zero
    std_s : standard deviation of the offset, s; for "motion" with what gaits are asymmetric by
    confidence : 0 to 1; below 0.5 another offset is nearly as good
    detail : named values the confidence rests on
    notes : sentences on what contradicts it
    """

    method: str
    offset_ns: int
    center_ns: int
    skew_ppm: float
    skew_known: bool
    std_s: float
    confidence: float
    detail: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def apply(self, stamp_ns: IntArray) -> IntArray:
        """Return the stamps (N,) int64 ns on the other clock."""
        stamps = np.asarray(stamp_ns, dtype=np.int64)
        elapsed = stamps - self.center_ns
        slower = 1.0 / (1.0 + 1e-6 * self.skew_ppm) - 1.0
        corrected: IntArray = stamps + self.offset_ns + np.rint(slower * elapsed).astype(np.int64)
        return corrected

    def offset_at(self, other_ns: int) -> int:
        """Return what is added to the stamp that becomes ``other_ns`` on the other clock, ns."""
        elapsed_ns = other_ns - self.center_ns - self.offset_ns
        return self.offset_ns - round(1e-6 * self.skew_ppm * elapsed_ns)

    def moved(self, series: ImuSeries) -> ImuSeries:
        """Return the series with its stamps on the other clock."""
        return replace(series, stamp_ns=self.apply(series.stamp_ns))
