"""Findings on the stream of a foot: stuck values, standstill, gaps, stamps, range."""

from __future__ import annotations

from collections.abc import Iterator

from ..quality import Quality
from ..stuck_values import Channel
from .finding import Finding, Severity
from .finding_kinds import FindingKind

STUCK_SHARE = 0.1  # of the samples; with more, the recording is of no use
LATE_STANDSTILL_S = 5.0
MISSING_SHARE = 0.01  # of the samples; 5 % cost 0.7 m on a rectangle of 55 m
LEAST_MISSING = 3
UNCERTAIN = 0.25  # of the interval; with more jitter nothing tells what is missing
JITTER_S = 1.5e-3  # 2 ms cost 0.3 m there, 6 ms cost 3.1 m
LOW_RATE_HZ = 40.0  # the swing of a foot needs more
EQUAL_SHARE = 0.2  # of the samples; with more, the recording is of no use
EVEN_THEM = "even the stamps out with 'dualfoot import BAG --stamps index -o NEW'"


def find_stuck_values(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding for each channel that repeats itself."""
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
            f"{foot}/{stuck.what}",
        )


def find_no_standstill(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the foot never stands still."""
    if quality.stand is None:
        yield Finding(
            FindingKind.NO_STANDSTILL,
            Severity.WARNING,
            f"{foot} foot: there is no standstill of some seconds, so the gyro bias is known from "
            "stances only",
            "stand still with both feet on the ground for 5 s before walking",
            foot,
        )


def find_late_standstill(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the foot stands still long after the start only."""
    stand = quality.stand
    if stand is not None and stand.start_s > LATE_STANDSTILL_S:
        yield Finding(
            FindingKind.LATE_STANDSTILL,
            Severity.WARNING,
            f"{foot} foot: the first standstill begins {stand.start_s:.1f} s after the start, so "
            "the track begins with a gyro bias from less",
            "stand still with both feet on the ground for 5 s before walking",
            foot,
        )


def find_gaps(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when samples are missing in between."""
    if quality.gaps:
        yield Finding(
            FindingKind.GAPS,
            Severity.WARNING,
            f"{foot} foot: {quality.gaps} gaps, the longest {quality.longest_gap_s:.3f} s; "
            "samples are not interpolated across them, and a gap within a step harms the track",
            "check the link of the sensor and the load of the host",
            foot,
        )


def find_missing_samples(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when single samples are lost here and there."""
    due = quality.usable + quality.missing
    if quality.jitter_s * quality.rate_hz > UNCERTAIN:
        return
    if quality.missing >= LEAST_MISSING and quality.missing > MISSING_SHARE * due:
        yield Finding(
            FindingKind.MISSING_SAMPLES,
            Severity.WARNING,
            f"{foot} foot: {quality.missing} of {due} samples are missing "
            f"({quality.missing / due:.1%}), and a sample lost within a step harms the track",
            "check the link of the sensor and the load of the host",
            foot,
        )


def find_jitter(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the stamps are those of arrival, not of sampling."""
    if quality.jitter_s > JITTER_S:
        yield Finding(
            FindingKind.JITTER,
            Severity.WARNING,
            f"{foot} foot: the stamps jitter by {1e3 * quality.jitter_s:.1f} ms where a sensor "
            f"samples every {1e3 / quality.rate_hz:.1f} ms, so they seem to tell when samples "
            "arrived",
            f"{EVEN_THEM}; live stamp them with the time of the device (stamp: device), or evenly "
            "(stamp: even) where it sends none",
            foot,
        )


def find_overlaid_samples(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding where samples of two times lie between each other."""
    if quality.overlaid:
        yield Finding(
            FindingKind.OVERLAID,
            Severity.WARNING,
            f"{foot} foot: for {quality.overlaid.duration_s:.1f} s, "
            f"{quality.overlaid.start_s:.1f} s after the first sample, samples of two times or of "
            "two sensors lie between each other; the track is wrong from there on",
            "a bag that was sorted by a clock that had been set back is so: take the bag as it "
            "was recorded, or cut it there; let one sensor publish on the topic",
            foot,
        )


def find_low_rate(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the rate is too low for the swing of a foot."""
    if quality.rate_hz < LOW_RATE_HZ:
        yield Finding(
            FindingKind.LOW_RATE,
            Severity.WARNING,
            f"{foot} foot: {quality.rate_hz:.1f} Hz are too few to follow the swing of a foot",
            f"set the sensor to 60 Hz or more, at least to {LOW_RATE_HZ:.0f} Hz; if it is set so, "
            "the unit of the stamps or the rate that was given is wrong",
            foot,
        )


def find_bad_stamps(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when stamps repeat or go back."""
    if quality.duplicate or quality.out_of_order:
        yield Finding(
            FindingKind.STAMPS,
            Severity.WARNING,
            f"{foot} foot: {quality.duplicate} duplicate and {quality.out_of_order} out-of-order "
            "stamps are left out",
            about=foot,
        )


def find_equal_stamps(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when so many stamps repeat that most of the samples would be lost."""
    if quality.duplicate > EQUAL_SHARE * quality.samples:
        yield Finding(
            FindingKind.EQUAL_STAMPS,
            Severity.ERROR,
            f"{foot} foot: {quality.duplicate} of {quality.samples} samples have the stamp of the "
            "one before, as of a link that delivers several at once",
            EVEN_THEM,
            foot,
        )


def find_clipping(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when values stay at the end of the sensor's range."""
    if quality.clipped_force or quality.clipped_rate:
        yield Finding(
            FindingKind.CLIPPING,
            Severity.WARNING,
            f"{foot} foot: the sensor clips ({quality.clipped_force} samples at "
            f"{quality.peak_force:.4g} m/s^2, {quality.clipped_rate} at {quality.peak_rate:.4g} "
            "rad/s)",
            "choose a wider range",
            foot,
        )
