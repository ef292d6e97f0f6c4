"""Findings on the samples of the feet: values, units, clocks, standstill, gaps, range."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core import STANDARD_GRAVITY
from .finding import Finding, FindingKind, Severity
from .quality import Quality
from .stuck_values import Channel

GRAVITY_ERROR = 1.5  # m/s^2, more than any accelerometer bias
FASTEST_FOOT = 35.0  # rad/s (2000 deg/s); no foot turns faster for long
RATE_RATIO = 1.5
STUCK_SHARE = 0.1  # of the samples; with more, the recording is of no use
LATE_STANDSTILL_S = 5.0
FORCE_UNIT_SIZES = {"g": 1.0, "mg": 1e3}  # what a sensor at rest reads in them


def foot_findings(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield the findings on samples that cannot be used at all."""
    if quality.not_finite:
        yield Finding(
            FindingKind.NOT_FINITE,
            Severity.ERROR,
            f"{foot} foot: {quality.not_finite} of {quality.samples} samples are not finite (nan "
            f"or inf), the first is sample {quality.first_not_finite}",
            "repair the driver or the export, or leave them out with 'dualfoot evaluate "
            "--allow-nan'",
        )
    if quality.usable < 2:
        yield Finding(
            FindingKind.EMPTY,
            Severity.ERROR,
            f"{foot} foot: {quality.usable} of {quality.samples} samples can be used "
            f"({quality.not_finite} not finite, {quality.duplicate} duplicate and "
            f"{quality.out_of_order} out-of-order stamps)",
            "check the driver's stamps and values",
        )
    elif quality.begins_anew:
        yield Finding(
            FindingKind.BEGINS_ANEW,
            Severity.ERROR,
            f"{foot} foot: the stamps jump back and go on from there, so these are two recordings "
            "in one bag",
            "cut it there",
        )


def unit_findings(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield the findings on values that are not in SI units."""
    stand = quality.stand
    gravity = quality.median_force if stand is None else stand.gravity
    tolerance = GRAVITY_ERROR if stand else 2 * GRAVITY_ERROR
    if abs(gravity - STANDARD_GRAVITY) > tolerance:
        where = "at rest" if stand else "in the median"
        reading = f"{foot} foot: the specific force is {gravity:.4g} {where}"
        yield _force_finding(reading, gravity)
    if quality.high_rate > FASTEST_FOOT:
        yield Finding(
            FindingKind.RATE_UNIT,
            Severity.ERROR,
            f"{foot} foot: the angular rate exceeds {quality.high_rate:.4g} for 2 % of the time, "
            "so it is in deg/s and not in rad/s",
            "convert the bag with 'dualfoot import BAG --rate-unit deg/s -o NEW', and live set "
            "the unit in the driver or units.angular_rate of imu_adapter",
        )


def _force_finding(reading: str, gravity: float) -> Finding:
    for unit, size in FORCE_UNIT_SIZES.items():
        if abs(gravity / size - 1.0) < 0.2:
            text = f"{reading}, so it is in {unit} and not in m/s^2"
            remedy = (
                f"convert the bag with 'dualfoot import BAG --force-unit {unit} -o NEW', and live "
                "set the unit in the driver or units.specific_force of imu_adapter"
            )
            return Finding(FindingKind.FORCE_UNIT, Severity.ERROR, text, remedy)
    if gravity < 3.0:
        text = f"{reading}, so gravity was taken out"
        remedy = (
            "publish what the accelerometer reads (specific force, 9.8 m/s^2 upwards at rest), "
            "not the linear acceleration"
        )
    else:
        text = f"{reading} where {STANDARD_GRAVITY:.1f} m/s^2 is due"
        remedy = "check the unit and the scale of the accelerometer"
    return Finding(FindingKind.FORCE_UNIT, Severity.ERROR, text, remedy)


def pair_findings(left: Quality, right: Quality) -> Iterator[Finding]:
    """Yield the findings on clocks and rates of the two feet against each other."""
    if min(left.end_s, right.end_s) <= max(left.start_s, right.start_s):
        yield Finding(
            FindingKind.NO_OVERLAP,
            Severity.ERROR,
            f"left and right do not overlap in time (left {left.start_s:.3f} to {left.end_s:.3f} "
            f"s, right {right.start_s:.3f} to {right.end_s:.3f} s), so the clocks of the devices "
            "were not synchronised",
            "'dualfoot sync BAG -o ALIGNED' finds the offset from how the feet moved, and "
            "'dualfoot import SOURCE --right-offset SECONDS' takes a known one",
        )
    ratio = left.rate_hz / right.rate_hz
    if np.isfinite(ratio) and not 1 / RATE_RATIO < ratio < RATE_RATIO:
        yield Finding(
            FindingKind.RATES,
            Severity.WARNING,
            f"the feet have different rates ({left.rate_hz:.1f} and {right.rate_hz:.1f} Hz)",
            "set both sensors to the same rate",
        )


def stream_findings(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield the findings on how the samples of a foot came: stuck, standing, gaps, range."""
    yield from _stuck(foot, quality)
    yield from _standstill(foot, quality)
    yield from _gaps_and_stamps(foot, quality)
    if quality.clipped_force or quality.clipped_rate:
        yield Finding(
            FindingKind.CLIPPING,
            Severity.WARNING,
            f"{foot} foot: the sensor clips ({quality.clipped_force} samples at "
            f"{quality.peak_force:.4g} m/s^2, {quality.clipped_rate} at {quality.peak_rate:.4g} "
            "rad/s)",
            "choose a wider range",
        )


def _stuck(foot: str, quality: Quality) -> Iterator[Finding]:
    for stuck in quality.stuck:
        whole = stuck.what is Channel.SENSOR
        subject = "the sensor repeats itself" if whole else f"{stuck.what} is stuck"
        times = "once" if stuck.times == 1 else f"{stuck.times} times"
        yield Finding(
            FindingKind.STUCK,
            Severity.ERROR if stuck.share > STUCK_SHARE else Severity.WARNING,
            f"{foot} foot: {subject} {times}, first {stuck.first_s:.1f} s after the start and for "
            f"up to {stuck.longest_s:.2f} s ({stuck.share:.1%} of the samples have not changed)",
            "check the sensor and its driver, which may fill gaps with old values",
        )


def _standstill(foot: str, quality: Quality) -> Iterator[Finding]:
    stand = quality.stand
    if stand is None:
        yield Finding(
            FindingKind.NO_STANDSTILL,
            Severity.ERROR,
            f"{foot} foot: there is no standstill of some seconds, without which neither the gyro "
            "bias nor up and down are known",
            "stand still with both feet on the ground for 5 s before walking",
        )
    elif stand.start_s > LATE_STANDSTILL_S:
        yield Finding(
            FindingKind.LATE_STANDSTILL,
            Severity.WARNING,
            f"{foot} foot: the first standstill begins {stand.start_s:.1f} s after the start; "
            "what is before it is not tracked",
        )


def _gaps_and_stamps(foot: str, quality: Quality) -> Iterator[Finding]:
    if quality.gaps:
        yield Finding(
            FindingKind.GAPS,
            Severity.WARNING,
            f"{foot} foot: {quality.gaps} gaps, the longest {quality.longest_gap_s:.3f} s; "
            "samples are not interpolated across them, and a gap within a step harms the track",
            "check the link of the sensor and the load of the host",
        )
    if quality.duplicate or quality.out_of_order:
        yield Finding(
            FindingKind.STAMPS,
            Severity.WARNING,
            f"{foot} foot: {quality.duplicate} duplicate and {quality.out_of_order} out-of-order "
            "stamps are left out",
        )
