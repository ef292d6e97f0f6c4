"""Offset of two devices' clocks from how they moved, where arrival times are of no use."""

from __future__ import annotations

from ...core.series import ImuSeries
from ..errors import TimingError
from .gait import offset_by_gait
from .result import Offset
from .shake import find_shakes, offset_by_shake

METHODS = ("auto", "motion", "shake")


def offset_by_motion(left: ImuSeries, right: ImuSeries, method: str = "auto") -> Offset:
    """Return what to add to the right foot's stamps to bring them to the left foot's clock.

    "shake" looks for a time at which both devices were shaken together, "motion" for the gait;
    "auto" takes a shake where there is one, as it is more exact, else the gait.

    Raises
    ------
    TimingError
        When the recordings show nothing to go by, or the method is unknown.
    """
    if method not in METHODS:
        raise TimingError(f"method is '{method}'; allowed is one of {', '.join(METHODS)}")
    if method == "motion":
        return offset_by_gait(left, right)
    shakes = find_shakes(left, right)
    if shakes or method == "shake":
        return offset_by_shake(left, right, shakes)
    return offset_by_gait(left, right)
