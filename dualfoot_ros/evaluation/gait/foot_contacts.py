"""Initial contact and lift-off of a foot, from the inclination of its sole.

The zero-velocity stance of the tracker is the foot-flat part of the stance phase: it begins after
the sole's slap and ends when the heel rises.  Gait laboratories count stance from initial contact
to lift-off (toe-off).  Both show in the pitch of a shoe, whose rate has a peak at each (Sabatini
et al. 2005; Mariani et al. 2013): lift-off in the middle of the peak of the nose-down rate at
push-off, initial contact where the nose-up angle before landing is largest and the slap of the
sole begins.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import (
    FloatArray,
    FootTrajectory,
    new_array,
    picked,
    placed,
    quaternion_matrices,
    row_blocks,
)
from ..frames.association import Footfalls, seconds

LEAST_STRIDE_M = 0.3
MOST_TURN_COSINE = math.cos(math.radians(20.0))
LEAST_SWING = 5
"""Samples from stance to stance in which contact and lift-off can be told apart."""

PEAK_SHARE = 0.8
"""Share of the largest rate of push-off above which its peak is taken, to find its middle.

The top of the peak is flat, or even has two tips 30 ms apart: the higher one is chance, and so was
lift-off by 12 ms and the angle by 5 degrees.  The middle of the peak does not depend on it.
"""


@dataclass(frozen=True)
class FootContacts:
    """Moments and angles of one foot, one row a stance; nan where there is none.

    Attributes
    ----------
    contact_s : (M,) s since the start of the track, the initial contact before each stance
    lift_off_s : (M,) s, the lift-off after each stance; nan too where the foot pushed off twice
        before it stood again, so that a stance between was missed
    contact_deg, lift_off_deg : (M,) inclination of the sole then, toes up positive, against how
        the foot stood flat
    """

    contact_s: FloatArray
    lift_off_s: FloatArray
    contact_deg: FloatArray
    lift_off_deg: FloatArray


def find_contacts(track: FootTrajectory) -> FootContacts:
    """Find initial contacts and lift-offs of a foot; a walk without strides has none."""
    falls = Footfalls.of(track)
    found = FootContacts(*(np.full(len(falls), np.nan) for _ in range(4)))
    forward = forward_axis(track, falls)
    if forward is None:
        return found
    time = placed(seconds(track.stamp_ns, int(track.stamp_ns[0])))
    up = inclination(track, forward)
    flat = time[falls.middle], up[falls.middle]
    for part in row_blocks(len(time)):
        up[part] -= np.interp(time[part], *flat)
    toes = _Toes(time, up)
    swings = zip(falls.bounds[:-1, 1].tolist(), falls.bounds[1:, 0].tolist(), strict=True)
    for k, (begin, last) in enumerate(swings):
        first = begin - 1
        if last - first >= LEAST_SWING:
            found.lift_off_s[k], found.contact_s[k + 1] = _moments(*toes.swing(first, last))
    found.lift_off_deg[:] = toes.degrees_at(found.lift_off_s)
    found.contact_deg[:] = toes.degrees_at(found.contact_s)
    return found


class _Toes:
    """Inclination of the sole against the flat foot, rad, and its rate, at the (N,) times."""

    def __init__(self, time: FloatArray, up: FloatArray) -> None:
        self.time, self.up, self.rate = time, up, new_array(time.shape)
        self._changes = new_array((len(time) - 1,), np.int64)
        for part in row_blocks(len(time) - 2):
            around = slice(part.start, part.stop + 2)
            steps = np.diff(time[around])
            middle = slice(part.start + 1, part.stop + 1)
            self.rate[middle] = _rates(steps, up[around])
            changes = np.cumsum(steps[1:] != steps[:-1])
            self._changes[middle] = self._changes[part.start] + changes

    def swing(self, first: int, last: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return times, inclination and rate from the sample ``first`` to ``last``, by itself."""
        part = slice(first, last + 1)
        time, up, rate = self.time[part], self.up[part], self.rate[part].copy()
        if self._changes[first] == self._changes[last - 1]:  # in even steps it has other sums
            return time, up, np.gradient(up, time)
        rate[0] = (up[1] - up[0]) / (time[1] - time[0])
        rate[-1] = (up[-1] - up[-2]) / (time[-1] - time[-2])
        return time, up, rate

    def degrees_at(self, moments: FloatArray) -> FloatArray:
        """Return the inclination at (M,) moments, degrees."""
        return np.degrees(np.interp(moments, self.time, self.up))


def _rates(steps: FloatArray, values: FloatArray) -> FloatArray:
    """Return the rates (N,) in the middle of ``values`` (N + 2,), N + 1 uneven steps apart.

    They are numpy's ``gradient`` to the bit.
    """
    before, after = steps[:-1], steps[1:]
    first = -after / (before * (before + after))
    second = (after - before) / (before * after)
    third = before / (after * (before + after))
    rates: FloatArray = first * values[:-2] + second * values[1:-1] + third * values[2:]
    return rates


def forward_axis(
    track: FootTrajectory, falls: Footfalls, places: FloatArray | None = None
) -> FloatArray | None:
    """Return the (3,) axis in the sensor that is level and points ahead while the foot stands.

    It is the median direction of the straight strides, so the mounting need not be known; None
    where there is no such stride.  ``places`` (M, 3) are the means of the stances, where they are
    known already.
    """
    places = falls.mean(track.position) if places is None else places
    ways = np.diff(places, axis=0)[:, :2]
    lengths = np.linalg.norm(ways, axis=1)
    long = np.flatnonzero(lengths >= LEAST_STRIDE_M)
    ahead = np.column_stack([ways[long] / lengths[long, np.newaxis], np.zeros(len(long))])
    to_body = np.swapaxes(quaternion_matrices(picked(track.quaternion, falls.middle)), 1, 2)
    axes = (to_body[long] @ ahead[:, :, np.newaxis])[:, :, 0]
    after = (to_body[long + 1] @ ahead[:, :, np.newaxis])[:, :, 0]
    x, y, z = (axes * after).T
    axes = axes[x + y + z >= MOST_TURN_COSINE]
    if not len(axes):
        return None
    middle: FloatArray = np.median(axes, axis=0)
    return middle / np.linalg.norm(middle)


def inclination(track: FootTrajectory, axis: FloatArray) -> FloatArray:
    """Return the (N,) elevation in rad of a sensor's ``axis`` (3,) above the horizon."""
    angles = new_array((len(track),))
    for part in row_blocks(len(track)):
        x, y, z, w = track.quaternion[part].T
        up = (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
        elevation = up[0] * axis[0] + up[1] * axis[1] + up[2] * axis[2]
        angles[part] = np.arcsin(np.clip(elevation, -1.0, 1.0))
    return angles


def _moments(time: FloatArray, pitch: FloatArray, rate: FloatArray) -> tuple[float, float]:
    """Return lift-off and initial contact of a swing, s; ``pitch`` (K,) rad, toes up positive."""
    lows = _lows(pitch)
    lowest, last = (max(2, lows[k]) for k in (0, -1))
    on = _peak(time, pitch, last + int(np.argmax(pitch[last:])))
    if len(lows) > 1:
        return math.nan, on
    return _middle_of_peak(time, -rate, int(np.argmin(rate[: lowest + 1]))), on


def _lows(pitch: FloatArray) -> list[int]:
    """Return where the toes point down most: once a swing, twice where a stance was missed."""
    lowest = int(pitch.argmin())
    least = float(pitch[lowest])
    deep = np.flatnonzero(pitch <= max(least, 0.5 * least))
    if least < 0.0 and len(deep) == deep[-1] - deep[0] + 1:  # as nearly always: in one dip
        return [lowest]
    split = np.maximum(pitch[deep[:-1]], pitch[deep[1:]]) > 0.0
    for k in np.flatnonzero(np.diff(deep) > 1).tolist():
        split[k] = pitch[deep[k] : deep[k + 1] + 1].max() > 0.0
    ends = np.flatnonzero(split) + 1
    return [int(dip[np.argmin(pitch[dip])]) for dip in np.split(deep, ends)]


def _middle_of_peak(time: FloatArray, value: FloatArray, index: int) -> float:
    """Return the middle of the peak at ``index``, where ``value`` is near its top, s."""
    level = PEAK_SHARE * value[index]
    below = np.flatnonzero(value < level)
    before, after = below[below < index], below[below > index]
    rise = _crossing(time, value, level, int(before[-1]), 1) if len(before) else time[0]
    fall = _crossing(time, value, level, int(after[0]), -1) if len(after) else time[-1]
    return float(rise + fall) / 2


def _crossing(
    time: FloatArray, value: FloatArray, level: float, below: int, towards: int
) -> float:
    """Return when a line through the sample ``below`` and its neighbour crosses ``level``, s."""
    above = below + towards
    rise = value[above] - value[below]
    if rise == 0.0:
        return float(time[above])
    share = (level - value[below]) / rise
    return float(time[below] + share * (time[above] - time[below]))


def _peak(time: FloatArray, value: FloatArray, index: int) -> float:
    """Return the moment of the peak at ``index``, of the parabola through three samples."""
    if not 0 < index < len(value) - 1:
        return float(time[index])
    before, top, after = value[index - 1 : index + 2]
    bend = before - 2 * top + after
    shift = 0.0 if bend >= 0 else 0.5 * (before - after) / bend
    shift = min(max(shift, -0.5), 0.5)
    return float(time[index] + shift * (time[index + 1] - time[index]))
