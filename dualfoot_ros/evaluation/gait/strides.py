"""Strides of a walk: one row a stride of a foot, with the parameters of gait laboratories.

A stride goes from one placement of a foot to its next (Perry and Burnfield 2010); in time it goes
from initial contact to the next initial contact.  Step length and step width are taken against the
line of the stride, as Huxham et al. 2006 define them, so they hold on curved paths too.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import dataclass, fields

import numpy as np

from ...core import FEET, FloatArray, FootTrajectory, picked, quaternion_matrices
from ...inspection import LEAST_HOLE_S, longest_holes_s
from ..frames.association import Footfalls, seconds
from .foot_contacts import FootContacts, find_contacts, forward_axis

LEAST_LENGTH_M = 0.1
"""A foot that is set down nearer than this has not made a stride."""

SLOWEST_STRIDE_S = 2.5
STEADY_TURN_DEG = 20.0
STEADY_RISE_M = 0.1


@dataclass(frozen=True)
class Stride:
    """One stride of one foot; nan where a parameter is not known.

    Attributes
    ----------
    foot : "left" or "right"
    number : 1 for the first stride of the foot
    start_ns, end_ns : middles of the stances before and after
    start_s : s from the start of the track to ``start_ns``
    stride_length_m : horizontal distance of the placements before and after
    step_length_m, step_width_m : of the step that ends the stride, along and across the line of
        the stride, against the other foot as it stands; the width is negative when feet cross
    rise_m : height of the placement after above the one before
    stride_time_s : initial contact to initial contact
    stance_time_s, swing_time_s : initial contact to lift-off, lift-off to initial contact
    stance_percent : stance time in percent of the stride time
    step_time_s : initial contact of the other foot to that which ends the stride
    cadence_steps_per_min : two steps a stride time
    speed_m_per_s : stride length over stride time
    clearance_m : largest height of the sensor in the swing above the line between the placements
    contact_deg, lift_off_deg : inclination of the sole at contact (which ends the stride) and at
        lift-off, against the flat foot; toes up positive
    turn_deg : change of the foot's heading over the stride, to the left positive
    steady : neither the first nor the last stride of a bout, straight, level, all samples there
    """

    foot: str
    number: int
    start_ns: int
    end_ns: int
    start_s: float
    stride_length_m: float
    step_length_m: float
    step_width_m: float
    rise_m: float
    stride_time_s: float
    stance_time_s: float
    swing_time_s: float
    stance_percent: float
    step_time_s: float
    cadence_steps_per_min: float
    speed_m_per_s: float
    clearance_m: float
    contact_deg: float
    lift_off_deg: float
    turn_deg: float
    steady: bool


def strides_of(
    left: FootTrajectory,
    right: FootTrajectory,
    contacts: tuple[FootContacts, FootContacts] | None = None,
) -> tuple[Stride, ...]:
    """Return the strides of both feet in the order of time.

    Parameters
    ----------
    left, right : tracks with equal stamps
    contacts : of the left and the right foot, where they are known better than from the tracks
    """
    found = contacts or (find_contacts(left), find_contacts(right))
    feet = [_Foot.of(track, own) for track, own in zip((left, right), found, strict=True)]
    rows = [
        stride
        for index, foot in enumerate(FEET)
        for stride in _strides(foot, feet[index], feet[1 - index])
    ]
    return tuple(sorted(rows, key=lambda stride: stride.end_ns))


@dataclass(frozen=True)
class _Foot:
    """A foot stance by stance: M stances, in plain numbers where these are read one by one.

    Attributes
    ----------
    position : (N, 3) m, of the track
    place : (M, 3) m, where it stood
    way_m : (M - 1,) m, horizontal distance from place to place
    begun, ended : one-past-last epoch of each stance but the last, first epoch of the next one
    stamp_ns, time_s : of the middles of the stances
    stood_from_s, stood_to_s : s, first and last epoch of every stance
    heading : rad, in the middle of every stance
    is_whole : (M,) whether no samples were missing from the step before a stance to that after it
    contact_s, lift_off_s, contact_deg, lift_off_deg : as in :class:`FootContacts`
    """

    position: FloatArray
    place: FloatArray
    way_m: list[float]
    begun: list[int]
    ended: list[int]
    stamp_ns: list[int]
    time_s: list[float]
    stood_from_s: list[float]
    stood_to_s: list[float]
    heading: list[float]
    is_whole: list[bool]
    contact_s: list[float]
    lift_off_s: list[float]
    contact_deg: list[float]
    lift_off_deg: list[float]

    @classmethod
    def of(cls, track: FootTrajectory, contacts: FootContacts) -> _Foot:
        falls = Footfalls.of(track)
        time = seconds(track.stamp_ns, int(track.stamp_ns[0]))
        place = falls.mean(track.position)
        axis = forward_axis(track, falls, place)
        ahead = np.array([1.0, 0.0, 0.0]) if axis is None else axis
        faced = quaternion_matrices(picked(track.quaternion, falls.middle)) @ ahead
        bounds = np.reshape(falls.bounds, (-1, 2))
        return cls(
            track.position,
            place,
            np.hypot(*np.diff(place, axis=0)[:, :2].T).tolist(),
            bounds[:-1, 1].tolist(),
            bounds[1:, 0].tolist(),
            track.stamp_ns[falls.middle].tolist(),
            time[falls.middle].tolist(),
            time[bounds[:, 0]].tolist(),
            time[bounds[:, 1] - 1].tolist(),
            [math.atan2(y, x) for x, y, _ in faced.tolist()],
            (longest_holes_s(track, bounds) < LEAST_HOLE_S).tolist(),
            *(getattr(contacts, field.name).tolist() for field in fields(contacts)),
        )


def _strides(name: str, foot: _Foot, other: _Foot) -> list[Stride]:
    rows: list[Stride] = []
    for k, way in enumerate(foot.way_m):
        if way >= LEAST_LENGTH_M:
            rows.append(_stride(name, len(rows) + 1, k, foot, other))
    return rows


def _stride(name: str, number: int, k: int, foot: _Foot, other: _Foot) -> Stride:
    times = _times(k, foot)
    stood = _standing(other, k, foot)
    length = foot.way_m[k]
    step, width = _step(name, k, foot, other, stood)
    rise = float(foot.place[k + 1, 2] - foot.place[k, 2])
    turn = math.degrees(math.remainder(foot.heading[k + 1] - foot.heading[k], math.tau))
    before = math.nan if stood is None else other.contact_s[stood]
    return Stride(
        foot=name,
        number=number,
        start_ns=foot.stamp_ns[k],
        end_ns=foot.stamp_ns[k + 1],
        start_s=foot.time_s[k],
        stride_length_m=length,
        step_length_m=step,
        step_width_m=width,
        rise_m=rise,
        stride_time_s=times[0],
        stance_time_s=times[1],
        swing_time_s=times[2],
        stance_percent=100.0 * times[1] / times[0],
        step_time_s=_within_a_stride(foot.contact_s[k + 1] - before),
        cadence_steps_per_min=120.0 / times[0],
        speed_m_per_s=length / times[0],
        clearance_m=_clearance(k, foot),
        contact_deg=foot.contact_deg[k + 1],
        lift_off_deg=foot.lift_off_deg[k],
        turn_deg=turn,
        steady=_is_steady(k, foot, times[0], turn, rise),
    )


def _times(k: int, foot: _Foot) -> tuple[float, float, float]:
    """Return stride, stance and swing time, s.

    They are nan for a stride that began from standing, and where a stance was missed.
    """
    contact, lift_off = foot.contact_s, foot.lift_off_s
    known = math.isfinite(lift_off[k])
    stride = _within_a_stride(contact[k + 1] - contact[k]) if known else math.nan
    stance = lift_off[k] - contact[k] if math.isfinite(stride) else math.nan
    return stride, stance, contact[k + 1] - lift_off[k]


def _within_a_stride(time_s: float) -> float:
    """Return a time, or nan where the walker paused in it."""
    return time_s if 0.0 < time_s <= SLOWEST_STRIDE_S else math.nan


def _standing(other: _Foot, k: int, foot: _Foot) -> int | None:
    """Return which stance of the other foot lies in the middle of the swing after stance ``k``."""
    middle = 0.5 * (foot.stood_to_s[k] + foot.stood_from_s[k + 1])
    next_one = bisect_left(other.stood_to_s, middle)
    stands = next_one < len(other.stood_to_s) and other.stood_from_s[next_one] <= middle
    return next_one if stands else None


def _step(name: str, k: int, foot: _Foot, other: _Foot, stood: int | None) -> tuple[float, float]:
    """Return length and width of the step that ends the stride (Huxham et al. 2006), m.

    They are nan where samples of the other foot were missing beside its stance.
    """
    if stood is None or not other.is_whole[stood]:
        return math.nan, math.nan
    way = (foot.place[k + 1] - foot.place[k])[:2]
    along = way / foot.way_m[k]
    across = np.array([-along[1], along[0]]) * (1.0 if name == FEET[0] else -1.0)
    reach = (foot.place[k + 1] - other.place[stood])[:2]
    return float(reach @ along), float(reach @ across)


def _clearance(k: int, foot: _Foot) -> float:
    """Return the largest height in the swing above the straight line of the placements, m."""
    first, last = foot.begun[k], foot.ended[k]
    if last <= first:
        return math.nan
    swing = foot.position[first:last]
    way = foot.place[k + 1] - foot.place[k]
    share = (swing - foot.place[k])[:, :2] @ way[:2] / (way[:2] @ way[:2])
    line = foot.place[k, 2] + np.minimum(np.maximum(share, 0.0), 1.0) * way[2]
    return float((swing[:, 2] - line).max())


def _is_steady(k: int, foot: _Foot, stride_s: float, turn_deg: float, rise_m: float) -> bool:
    """Tell strides of even walking; those that leave or reach a stand are none.

    Nor are those beside missing samples: what was walked there is put right in the next stance.
    """
    if not math.isfinite(stride_s) or k + 2 >= len(foot.heading) or not foot.is_whole[k]:
        return False
    contact = foot.contact_s
    goes_on = math.isfinite(_within_a_stride(contact[k + 2] - contact[k + 1]))
    return goes_on and abs(turn_deg) <= STEADY_TURN_DEG and abs(rise_m) <= STEADY_RISE_M
