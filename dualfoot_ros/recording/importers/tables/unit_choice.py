"""The unit of force, rate and field: told by option, name or layout and checked, or by the motion.

A unit that the motion contradicts is refused, unless it was given by an option: whoever gives one
has looked.  A unit that nobody tells is taken from the motion if only one is possible.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ....core import FORCE_UNITS, RATE_UNITS, STANDARD_GRAVITY, FloatArray, RecordingError
from ...unit_evidence import UnitEvidence
from .assumptions import Assumption, Origin
from .column_choice import Columns
from .table_file import TableFile
from .table_layout import VECTORS, Layout
from .unit_words import ARBITRARY, FIELD_UNITS, RAW, SIZES

EARTH_T = (1e-5, 2e-4)  # bounds of a field of the earth, with a margin for iron nearby
NO_GRAVITY = 0.35  # of gravity: a force that stays below has gravity taken out
NEAR_GRAVITY = 0.015  # of it; cm/s^2, which is 2 % from mg, is beyond, and so are few sensors
WORDS = {"force": "specific force", "rate": "angular rate", "field": "magnetic field"}


@dataclass(frozen=True)
class Told:
    """A unit, and by whom it was told."""

    unit: str | None
    origin: Origin


def told_unit(
    path: Path, quantity: str, columns: Columns, given: Layout, known: Layout | None
) -> Told:
    """Return the unit that options, names or layout tell for a quantity.

    Raises
    ------
    RecordingError
        When the columns of the axes are in different units, unknown ones, or raw counts.
    """
    option = getattr(given, f"{quantity}_unit")
    if option is not None:
        return Told(option, Origin.OPTION)
    units = {columns.unit(role) for role in VECTORS[quantity]} - {None}
    if len(units) > 1:
        raise RecordingError(
            f"'{path}': the columns of the {WORDS[quantity]} are in different units "
            f"({', '.join(sorted(map(str, units)))}); rename them, or give --{quantity}-unit"
        )
    if units == {RAW}:
        raise RecordingError(
            f"'{path}': the {WORDS[quantity]} is in raw counts; export calibrated values, or "
            "scale the columns first"
        )
    if units:
        return Told(units.pop(), Origin.NAME)
    foreign = [name.text for role in VECTORS[quantity] if (name := columns.foreign(role))]
    if foreign:
        raise RecordingError(
            f"'{path}': column '{foreign[0]}' is in a unit that is not known here; allowed is "
            f"{', '.join(SIZES[quantity])}, so convert the columns of the {WORDS[quantity]}, or "
            f"give --{quantity}-unit to say that the name is wrong"
        )
    layout = None if known is None else getattr(known, f"{quantity}_unit")
    return Told(layout, Origin.LAYOUT)


def force_unit(
    path: Path, foot: str, told: Told, evidence: UnitEvidence
) -> tuple[str, Assumption]:
    """Return the unit of the specific force, checked against gravity, and what was assumed.

    Raises
    ------
    RecordingError
        When gravity says another unit, or nothing does.
    """
    likely = evidence.force_unit(FORCE_UNITS)
    reading = f"it reads {evidence.gravity:.4g} {'at rest' if evidence.quiet else 'in the median'}"
    if told.unit is None:
        if likely is None:
            raise RecordingError(
                f"'{path}': no unit of the specific force is told, and none fits gravity "
                f"({reading}); {_gravity_hint(evidence)}"
            )
        off = abs(evidence.gravity * FORCE_UNITS[likely] / STANDARD_GRAVITY - 1.0)
        value, doubtful = f"{likely} ({reading})", evidence.quiet and off > NEAR_GRAVITY
        if doubtful:
            value += f", {off:.1%} off gravity; if that is no error of scale, give --force-unit"
        return likely, Assumption(foot, WORDS["force"], value, Origin.MOTION, doubtful)
    if told.origin is not Origin.OPTION and _lacks_gravity(evidence, FORCE_UNITS[told.unit]):
        raise RecordingError(
            f"'{path}': the specific force in {told.unit} (by {told.origin}) {reading[3:]}, so "
            "gravity was taken out; export the acceleration with gravity, or give --force-unit "
            f"{told.unit} to insist"
        )
    contradicted = likely is not None and not evidence.force_fits(FORCE_UNITS[told.unit])
    if contradicted and told.origin is not Origin.OPTION:
        raise RecordingError(
            f"'{path}': the specific force should be in {told.unit} (by {told.origin}), but "
            f"{reading}, so it is in {likely}; give --force-unit {likely}, or --force-unit "
            f"{told.unit} to insist"
        )
    doubtful = not evidence.force_fits(FORCE_UNITS[told.unit])
    if doubtful and evidence.quiet and told.origin is not Origin.OPTION:
        raise RecordingError(
            f"'{path}': the specific force should be in {told.unit} (by {told.origin}), but "
            f"{reading}, which is gravity in no known unit; are these raw counts? Export "
            f"calibrated values, or give --force-unit {told.unit} to insist"
        )
    value = f"{told.unit} ({reading}){', which is not gravity' if doubtful else ''}"
    return told.unit, Assumption(foot, WORDS["force"], value, told.origin, doubtful)


def _lacks_gravity(evidence: UnitEvidence, size: float) -> bool:
    """Return whether the force is far below gravity, in this unit and in any other."""
    low = evidence.gravity * size < NO_GRAVITY * STANDARD_GRAVITY
    return low and evidence.force_unit(FORCE_UNITS) is None


def _gravity_hint(evidence: UnitEvidence) -> str:
    low = evidence.gravity < NO_GRAVITY * STANDARD_GRAVITY
    gone = "gravity may have been taken out: export the acceleration with gravity. Otherwise "
    return f"{gone if low else ''}give --force-unit m/s^2, g or mg"


def rate_unit(path: Path, foot: str, told: Told, evidence: UnitEvidence) -> tuple[str, Assumption]:
    """Return the unit of the angular rate, checked against the motion, and what was assumed.

    Raises
    ------
    RecordingError
        When the motion says another unit, or nothing does.
    """
    likely = evidence.rate_unit(RATE_UNITS)
    motion = "of a foot that walks" if evidence.walks else "of this motion"
    reading = f"98 % of the samples are below {evidence.high_rate:.4g}"
    if told.unit is None:
        if likely is None:
            raise RecordingError(
                f"'{path}': no unit of the angular rate is told, and the motion does not decide "
                f"({reading}); give --rate-unit deg/s or rad/s"
            )
        return likely, Assumption(foot, WORDS["rate"], f"{likely} ({reading})", Origin.MOTION)
    fits = evidence.rate_fits(RATE_UNITS[told.unit])
    if likely is not None and not fits and told.origin is not Origin.OPTION:
        raise RecordingError(
            f"'{path}': the angular rate should be in {told.unit} (by {told.origin}), but "
            f"{reading}, and rates {motion} are those in {likely}: the gyro does not fit the "
            f"accelerometer; give --rate-unit {likely}, or --rate-unit {told.unit} to insist"
        )
    value = f"{told.unit} ({reading}){'' if fits else f', which are no rates {motion}'}"
    return told.unit, Assumption(foot, WORDS["rate"], value, told.origin, not fits)


def field_in_tesla(
    table: TableFile, columns: Columns, values: FloatArray | None, foot: str, scale: float
) -> tuple[FloatArray | None, list[Assumption]]:
    """Return the magnetic field in T, where its unit is known and it is one of the earth.

    ``scale`` is what 1 of the ``values`` (N, 3) is in T, 0 for what the table tells.
    """
    if values is None:
        return None, []
    subject = WORDS["field"]
    if scale:
        text = f"{scale:g} T for 1"
        return values * scale, [Assumption(foot, subject, text, Origin.OPTION)]
    told = told_unit(table.path, "field", columns, table.given, table.known)
    if told.unit is None or told.unit == ARBITRARY:
        text = "left out: its unit is not known (--field-scale gives it)"
        return None, [Assumption(foot, subject, text, told.origin)]
    field_t = values * FIELD_UNITS[told.unit]
    size = float(np.nanmedian(np.linalg.norm(field_t, axis=1))) if len(field_t) else 0.0
    if not EARTH_T[0] < size < EARTH_T[1]:
        text = f"left out: in {told.unit} it would be {size:.3g} T, no field of the earth"
        return None, [Assumption(foot, subject, text, told.origin, doubtful=True)]
    return field_t, [Assumption(foot, subject, f"{told.unit} ({size:.2g} T)", told.origin)]
