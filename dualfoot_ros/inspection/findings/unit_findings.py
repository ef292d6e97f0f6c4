"""Findings on samples of a foot that are not in SI units."""

from __future__ import annotations

from collections.abc import Iterator

from ...core import STANDARD_GRAVITY
from ..quality import GravityFrom, Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind

GRAVITY_ERROR = 1.5  # m/s^2, more than any accelerometer bias
GRAVITY_RANGE = {  # m/s^2, beyond which no foot in SI units reads
    GravityFrom.STAND: (STANDARD_GRAVITY - GRAVITY_ERROR, STANDARD_GRAVITY + GRAVITY_ERROR),
    GravityFrom.STANCES: (
        STANDARD_GRAVITY - 2 * GRAVITY_ERROR,
        STANDARD_GRAVITY + 2 * GRAVITY_ERROR,
    ),
    GravityFrom.ALL: (4.0, 30.0),
}
FASTEST_FOOT = 35.0  # rad/s (2000 deg/s); no foot turns faster for long
FORCE_UNIT_SIZES = {"g": 1.0, "mg": 1e3}  # what a sensor at rest reads in them
GRAVITY_DOUBT = 0.5  # m/s^2, 5 %: more than the accelerometer biases of consumer sensors
UNIT_TOLERANCE = 0.2  # of that
NO_GRAVITY = 3.0  # m/s^2; a sensor that reads less has gravity taken out


def find_force_unit(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the specific force is not gravity in m/s^2 at rest."""
    low, high = GRAVITY_RANGE[quality.gravity_from]
    if quality.gravity < low or quality.gravity > high:
        reading = (
            f"{foot} foot: the specific force is {quality.gravity:.4g} {quality.gravity_from}"
        )
        text, remedy = _describe_force(reading, quality.gravity)
        yield Finding(FindingKind.FORCE_UNIT, Severity.ERROR, text, remedy, foot)


def find_gravity(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when gravity at rest is off by more than a bias, and less than a unit."""
    if quality.stand is None:
        return
    off = quality.stand.gravity - STANDARD_GRAVITY
    if GRAVITY_DOUBT < abs(off) <= GRAVITY_ERROR:
        yield Finding(
            FindingKind.GRAVITY,
            Severity.WARNING,
            f"{foot} foot: the accelerometer reads {quality.stand.gravity:.2f} m/s^2 at rest, "
            f"{off:+.2f} m/s^2 off",
            "calibrate it with 'dualfoot calibrate accelerometer', or check its scale in the "
            "driver",
            foot,
        )


def _describe_force(reading: str, gravity: float) -> tuple[str, str]:
    """Return text and remedy about a specific force that is not ``gravity``."""
    for unit, size in FORCE_UNIT_SIZES.items():
        if abs(gravity / size - 1.0) < UNIT_TOLERANCE:
            return (
                f"{reading}, so it is in {unit} and not in m/s^2",
                f"convert the bag with 'dualfoot import BAG --force-unit {unit} -o NEW', and live "
                "set the unit in the driver or units.specific_force of imu_adapter",
            )
    if gravity < NO_GRAVITY:
        return (
            f"{reading}, so gravity was taken out",
            "publish what the accelerometer reads (specific force, 9.8 m/s^2 upwards at rest), "
            "not the linear acceleration",
        )
    return (
        f"{reading} where {STANDARD_GRAVITY:.1f} m/s^2 is due",
        "check the unit and the scale of the accelerometer",
    )


def find_rate_unit(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the foot turns faster than any foot, or slower than one that walks."""
    if quality.high_rate > FASTEST_FOOT:
        yield Finding(
            FindingKind.RATE_UNIT,
            Severity.ERROR,
            f"{foot} foot: the angular rate exceeds {quality.high_rate:.4g} for 2 % of the time, "
            "so it is in deg/s and not in rad/s",
            "convert the bag with 'dualfoot import BAG --rate-unit deg/s -o NEW', and live set "
            "the unit in the driver or units.angular_rate of imu_adapter",
            foot,
        )
