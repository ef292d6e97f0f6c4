"""Findings on a gyro that does not fit the accelerometer beside it: unit, axes, scale."""

from __future__ import annotations

from collections.abc import Iterator

from ..gyro_agreement import GyroAgreement, RateError
from ..quality import Quality
from .finding import Finding, Severity
from .finding_kinds import FindingKind
from .unit_findings import FASTEST_FOOT

SCALE_ERROR = 0.055  # from 1; real sensors show up to 0.04, most of it accelerometer bias
SIGMAS = 2.5
MISFIT = 0.15  # median residual that nothing explains; real walks have at most 0.06
LEAST_CYCLES = 6  # to name what nothing explains
EVIDENCE = "the velocity and the direction of gravity that the gyro predicts from stance to stance"
AXES_WORDS = {
    RateError.NEGATED: "the angular rate has the wrong sign",
    RateError.MIRRORED: "the axes of the angular rate are left-handed against those of the force",
    RateError.TURNED: "the angular rate has other axes than the specific force",
}


def find_rate_degrees(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the angular rate is wrong by the factor of degrees."""
    gyro = quality.gyro
    if gyro is None or quality.high_rate > FASTEST_FOOT:
        return
    if gyro.error is RateError.TOO_SMALL:
        yield Finding(
            FindingKind.RATE_UNIT,
            Severity.ERROR,
            f"{foot} foot: the angular rate is 57 times too small ({_evidence(gyro)}), so rad/s "
            "were taken for deg/s and converted",
            "import it again with '--rate-unit rad/s', and live set the unit in the driver or "
            "units.angular_rate of imu_adapter to rad/s",
            foot,
        )
    elif gyro.error is RateError.TOO_LARGE:
        yield Finding(
            FindingKind.RATE_UNIT,
            Severity.ERROR,
            f"{foot} foot: the angular rate is 57 times too large ({_evidence(gyro)}), so it is "
            "in deg/s and not in rad/s",
            "convert the bag with 'dualfoot import BAG --rate-unit deg/s -o NEW', and live set "
            "the unit in the driver or units.angular_rate of imu_adapter",
            foot,
        )


def find_rate_axes(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the angular rate has other axes or signs than the force."""
    gyro = quality.gyro
    if gyro is not None and gyro.error in AXES_WORDS:
        yield Finding(
            FindingKind.RATE_AXES,
            Severity.WARNING,
            f"{foot} foot: {AXES_WORDS[gyro.error]} ({_evidence(gyro)}); the rate's axes "
            f"({gyro.axes}) would fit the force's (+x, +y, +z)",
            "give rate and force the same right-handed axes in the driver; mounting.* of "
            "imu_adapter and --axes of 'dualfoot import' turn both together only",
            foot,
        )


def find_rate_scale(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when the scale of the gyro is off by more than any gyro's."""
    gyro = quality.gyro
    if gyro is None or gyro.error is not RateError.NONE:
        return
    off = abs(gyro.scale - 1.0)
    if off > SCALE_ERROR and off > SIGMAS * gyro.scale_std:
        yield Finding(
            FindingKind.RATE_SCALE,
            Severity.WARNING,
            f"{foot} foot: the angular rate is {abs(1.0 / gyro.scale - 1.0):.0%} too "
            f"{'small' if gyro.scale > 1.0 else 'large'} against the specific force "
            f"(+- {gyro.scale_std:.0%}, from {gyro.cycles} steps)",
            "check the time of the samples, as the same is seen of samples that come at "
            f"{quality.rate_hz / gyro.scale:.3g} Hz and not at {quality.rate_hz:.3g} Hz, and the "
            "scale of the gyro or of the accelerometer in the driver; or calibrate them with "
            "'dualfoot calibrate'",
            foot,
        )


def find_rate_misfit(foot: str, quality: Quality) -> Iterator[Finding]:
    """Yield a finding when gyro and accelerometer disagree and nothing simple explains it."""
    gyro = quality.gyro
    if gyro is None or gyro.error is not RateError.UNEXPLAINED:
        return
    if gyro.residual > MISFIT and gyro.cycles >= LEAST_CYCLES:
        yield Finding(
            FindingKind.RATE_MISFIT,
            Severity.WARNING,
            f"{foot} foot: gyro and accelerometer contradict each other: {EVIDENCE} are off by "
            f"{gyro.residual:.2f} of gravity in the median of {gyro.cycles} steps",
            "check units, axes and ranges of both, and that rate and force of a message were "
            "measured at the same time",
            foot,
        )


def _evidence(gyro: GyroAgreement) -> str:
    return (
        f"over {gyro.cycles} steps {EVIDENCE} are off by {gyro.residual:.2f} of gravity, and by "
        f"{gyro.explained:.2f} with that corrected"
    )
