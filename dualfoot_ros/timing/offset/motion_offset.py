"""Offset of two devices' clocks from how they moved, where arrival times are of no use."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...core import ImuSeries, TimingError
from .gait_offset import offset_by_gait
from .result import DOUBT, Offset
from .shake import WINDOW_S, Shake, find_shakes, offset_by_shake

METHODS = ("auto", "motion", "shake")
NEAR_CYCLES = 0.25  # between shake and gait, to agree
FEW_CYCLES = 5.5  # within which the gait may be wrong by whole cycles


def offset_by_motion(left: ImuSeries, right: ImuSeries, method: str = "auto") -> Offset:
    """Return what to add to the right foot's stamps to bring them to the left foot's clock.

    "shake" looks for a time at which both devices were shaken together, "motion" for the gait;
    "auto" takes a shake where there is one, as it is more exact, else the gait.  A shake
    that would have the feet swing together is none, when the gait is sure.

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
    if not shakes and method == "auto":
        return offset_by_gait(left, right)
    shake = offset_by_shake(left, right, shakes)
    gait = _sure_gait(left, right, shakes)
    if gait is None:
        return shake
    return _contradicted(shake, gait, method)


def _sure_gait(left: ImuSeries, right: ImuSeries, shakes: list[Shake]) -> Offset | None:
    """Return the offset by the gait without the shakes, where it is sure; else None."""
    stamps_s = np.array([s.stamp_s for s in shakes])
    lags_s = np.array([s.lag_s for s in shakes])
    try:
        gait = offset_by_gait(_without(left, stamps_s + lags_s), _without(right, stamps_s))
    except TimingError:
        return None
    return gait if gait.confidence >= DOUBT else None


def _without(series: ImuSeries, middles_s: np.ndarray) -> ImuSeries:
    """Return the series with no specific force in the windows around ``middles_s`` (N,)."""
    force = series.specific_force.copy()
    for middle_s in middles_s:
        force[np.abs(series.stamp_ns * 1e-9 - middle_s) < 0.6 * WINDOW_S] = np.nan
    return replace(series, specific_force=force)


def _contradicted(shake: Offset, gait: Offset, method: str) -> Offset:
    """Return the shake, or the gait where the feet would swing together by the shake."""
    by_gait_ns = int(gait.apply(np.array([shake.center_ns]))[0]) - shake.center_ns
    cycles = 1e-9 * (shake.offset_ns - by_gait_ns) / gait.detail["cycle_s"]
    if abs(cycles) < NEAR_CYCLES:
        return shake
    in_turn = abs(cycles) < FEW_CYCLES and abs(cycles - round(cycles)) < NEAR_CYCLES
    if in_turn or method == "shake":
        note = f"the gait contradicts the shake: it says {1e-9 * by_gait_ns:+.2f} s"
        return replace(shake, notes=(note,))
    note = (
        f"the gait contradicts a shake that says {1e-9 * shake.offset_ns:+.2f} s; "
        "the method shake takes it all the same"
    )
    return replace(gait, notes=(note,))
