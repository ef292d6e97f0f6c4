"""Both feet of a recording on one clock, by whichever way there is to tell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...core import FEET, ImuSeries, IntArray, TimingError
from .arrival import offset_by_arrival, tells_arrivals
from .gait_offset import offset_by_gait
from .motion_offset import METHODS as MOTION_METHODS
from .motion_offset import offset_by_motion
from .result import DOUBT, Offset

METHODS = (*MOTION_METHODS, "arrival")


@dataclass(frozen=True)
class Synchronised:
    """Two recordings on one clock, and how that was told.

    Attributes
    ----------
    left, right : the series; on the left foot's clock, or by "arrival" on the host's
    applied : the offset of each foot that was moved
    offset_s : what is added to the right foot's stamps, relative to the left foot's, at the middle
    skew_ppm : how much faster the right foot's clock runs than the left foot's
    std_s, confidence : of the relative offset
    notes : sentences on what to be careful about
    """

    method: str
    left: ImuSeries
    right: ImuSeries
    applied: Mapping[str, Offset]
    offset_s: float
    skew_ppm: float
    skew_known: bool
    std_s: float
    confidence: float
    notes: tuple[str, ...]


def synchronise(
    left: ImuSeries,
    right: ImuSeries,
    arrival_ns: Mapping[str, IntArray] | None = None,
    method: str = "auto",
) -> Synchronised:
    """Bring two recordings on one clock.

    ``arrival_ns`` are the log times (N,) of each foot.  "auto" goes by the arrivals where they
    tell more than the stamps, else by a shake, else by the gait.

    Raises
    ------
    TimingError
        When the method is unknown or what it needs is not in the recording.
    """
    if method not in METHODS:
        raise TimingError(f"method is '{method}'; allowed is one of {', '.join(METHODS)}")
    series = {"left": left, "right": right}
    for foot in FEET:
        if len(series[foot]) < 2:
            raise TimingError(f"the {foot} foot has {len(series[foot])} samples; 2 are needed")
    logged = arrival_ns or {}
    telling = [f for f in FEET if f in logged and tells_arrivals(series[f].stamp_ns, logged[f])]
    if method == "arrival" and len(telling) < len(FEET):
        raise TimingError(
            "the log times of the recording follow its stamps and say nothing about the clocks; "
            "use the method motion or shake"
        )
    if method == "arrival" or (method == "auto" and len(telling) == len(FEET)):
        return _by_arrival(series, logged)
    return _by_motion(left, right, method)


def _by_motion(left: ImuSeries, right: ImuSeries, method: str) -> Synchronised:
    found = offset_by_motion(left, right, method)
    notes = found.notes
    applied = {"right": found}
    if abs(found.offset_ns) < 3e9 * found.std_s and found.skew_ppm == 0.0:
        notes += (
            f"the clocks agree within the uncertainty of {1e3 * found.std_s:.0f} ms already; "
            "the stamps are left as they are",
        )
        applied = {}
    return Synchronised(
        method=found.method,
        left=left,
        right=found.moved(right) if applied else right,
        applied=applied,
        offset_s=1e-9 * found.offset_ns,
        skew_ppm=found.skew_ppm,
        skew_known=found.skew_known,
        std_s=found.std_s,
        confidence=found.confidence,
        notes=notes,
    )


def _by_arrival(series: Mapping[str, ImuSeries], logged: Mapping[str, IntArray]) -> Synchronised:
    found = {foot: offset_by_arrival(foot, series[foot].stamp_ns, logged[foot]) for foot in FEET}
    moved = {foot: found[foot].moved(series[foot]) for foot in FEET}
    left, right = found["left"], found["right"]
    # both at one moment of the host's: by the devices' own stamps they may be hours apart
    host_ns = right.center_ns + right.offset_ns
    faster = (1.0 + 1e-6 * right.skew_ppm) / (1.0 + 1e-6 * left.skew_ppm) - 1.0
    return Synchronised(
        method="arrival",
        left=moved["left"],
        right=moved["right"],
        applied=found,
        offset_s=1e-9 * (right.offset_ns - left.offset_at(host_ns)),
        skew_ppm=1e6 * faster,
        skew_known=True,
        std_s=(left.std_s**2 + right.std_s**2) ** 0.5,
        confidence=min(left.confidence, right.confidence),
        notes=_contradiction(moved["left"], moved["right"]),
    )


def _contradiction(left: ImuSeries, right: ImuSeries) -> tuple[str, ...]:
    """Return a warning when the gait says clearly that the arrivals are wrong."""
    try:
        gait = offset_by_gait(left, right)
    except TimingError:
        return ()
    off_s = 1e-9 * gait.offset_ns
    if gait.confidence < DOUBT or abs(off_s) < 0.25 * gait.detail["cycle_s"]:
        return ()
    return (f"the gait says the feet are still {off_s:+.2f} s apart; try the method motion",)
