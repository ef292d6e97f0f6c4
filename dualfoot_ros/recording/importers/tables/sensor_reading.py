"""One sensor out of a table: its samples in SI and in its own axes, and what was assumed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ....core import (
    FORCE_UNITS,
    RATE_UNITS,
    BoolArray,
    FloatArray,
    ImuSeries,
    RecordingError,
)
from ...unit_evidence import unit_evidence
from .assumptions import Assumption, Origin
from .column_choice import Columns, missing
from .stamp_axis import Stamps, TimeSource, stamps_of
from .stream_join import Stream, are_apart, join
from .table_file import TableFile, rate_in
from .table_layout import Layout
from .unit_choice import Told, field_in_tesla, force_unit, rate_unit, told_unit


@dataclass(frozen=True)
class Reading:
    """The samples of one sensor in SI, in the axes of the device.

    Attributes
    ----------
    series : the samples
    assumptions : what was taken for granted
    layout : the layout as it was found, with which the next file of the kind can be read
    label : what the file calls the device, where it does
    wraps : whether the stamps are those of a device counter that wraps
    facts : key and value of the header
    """

    series: ImuSeries
    assumptions: tuple[Assumption, ...]
    layout: Layout
    label: str = ""
    wraps: bool = False
    facts: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Samples:
    """Vectors (N, 3) of one sensor in the units of the file, with their stamps."""

    stamps: Stamps
    force: FloatArray
    rate: FloatArray
    field: FloatArray | None


@dataclass(frozen=True)
class Request:
    """What is wanted from a table besides its layout: the foot, and tesla for 1 of its field."""

    foot: str
    field_scale: float = 0.0


def read_sensor_columns(
    table: TableFile, columns: Columns, request: Request, rows: BoolArray | None = None
) -> Reading:
    """Return the sensor of ``columns``; ``rows`` (N,) chooses those of one device.

    Raises
    ------
    RecordingError
        When a quantity is missing, or time or a unit is unknown or contradicted.
    """
    vectors = {name: columns.vector(name) for name in ("force", "rate", "field", "push", "turn")}
    increments = vectors["force"] is None or vectors["rate"] is None
    if increments and (vectors["push"] is None or vectors["turn"] is None):
        hint = table.layout.remark
        sentence = missing(table.path, table.dialect, columns, table.facts)
        raise RecordingError(f"{sentence}; {hint}" if hint else sentence)
    pair = ("push", "turn") if increments else ("force", "rate")
    parts = [vectors[name] or [] for name in pair]
    parts.append(vectors["field"] or [])
    cells = table.numbers([place for part in parts for place in part], _clocks(table, columns))
    values = cells.numbers
    first, second = len(parts[0]), len(parts[0]) + len(parts[1])
    apart = not increments and are_apart(cells.empty[:, :first], cells.empty[:, first:second])
    if apart:
        return _of_two_streams(table, columns, request, rows)
    keep = _kept(cells.empty[:, :second], rows) & table.timed(columns.places.get("time"))
    table.check_filled([*parts[0], *parts[1]], keep)
    dropped = _dropped(keep, rows, request.foot)
    stamps = stamps_of(time_source(table, columns, request.foot, keep))
    kept = values[keep]
    blocks = (kept[:, :first], kept[:, first:second], kept[:, second:] if parts[2] else None)
    if increments:
        text = "dv and dq, divided by the interval"
        note = Assumption(request.foot, "increments", text, Origin.NAME)
        samples = _from_increments(stamps, *blocks)
        return _in_si(table, columns, request, samples, [note, *dropped], True)
    return _in_si(table, columns, request, Samples(stamps, *blocks), dropped, False)


def _clocks(table: TableFile, columns: Columns) -> list[int]:
    """Return the columns of time and counter that are read together with the vectors."""
    found = [columns.places[role] for role in ("time", "counter") if role in columns.places]
    return [place for place in found if table.holds_numbers(place)]


def _of_two_streams(
    table: TableFile, columns: Columns, request: Request, rows: BoolArray | None
) -> Reading:
    """Return the sensor of a table in which rows hold either force or rate."""
    force, _ = read_stream(table, columns, "force", request.foot, rows)
    rate, stamps = read_stream(table, columns, "rate", request.foot, rows)
    stamp_ns, forces, rates = join(force, rate)
    samples = Samples(replace(stamps, stamp_ns=stamp_ns), forces, rates, None)
    text = f"interpolated to the {len(stamp_ns)} stamps of the gyro"
    note = Assumption(request.foot, "accelerometer", text, Origin.VALUES)
    return _in_si(table, columns, request, samples, [note], False)


def _kept(empty: BoolArray, rows: BoolArray | None) -> BoolArray:
    """Return which rows have all that is needed."""
    whole: BoolArray = np.asarray(~empty.any(axis=1))
    return whole if rows is None else whole & rows


def _dropped(keep: BoolArray, rows: BoolArray | None, foot: str) -> list[Assumption]:
    all_rows = len(keep) if rows is None else int(rows.sum())
    count = all_rows - int(keep.sum())
    if not count:
        return []
    text = f"{count} of {all_rows} left out, with empty cells"
    return [Assumption(foot, "rows", text, Origin.VALUES, doubtful=True)]


def _time_name(table: TableFile, place: int | None) -> str:
    """Return the name of the column of the time, or its number from 1 where it has none."""
    if place is None or not table.dialect.names:
        return "time"
    return table.dialect.names[place] or f"column {place + 1}"


def time_source(table: TableFile, columns: Columns, foot: str, keep: BoolArray) -> TimeSource:
    """Return what the table tells about time, for the rows ``keep`` (N,)."""
    layout, given = table.layout, table.given
    place = columns.places.get("time")
    values, exact = (None, None) if place is None else table.time(place)
    dated = exact is not None and not _is_plain_number(table, place)
    unit, origin = _time_unit(table, columns, dated)
    header = rate_in(table.facts)
    rate = given.rate_hz or header or layout.rate_hz
    told = Origin.OPTION if given.rate_hz else Origin.HEADER if header else Origin.LAYOUT
    counter = columns.places.get("counter")
    return TimeSource(
        table.path,
        foot,
        _time_name(table, place),
        int(keep.sum()),
        None if values is None else values[keep],
        None if exact is None else exact[keep],
        None if counter is None else table.numbers([counter]).numbers[keep, 0],
        unit,
        origin,
        () if dated else layout.time_units,
        rate,
        told,
        layout.wrap_bits if unit != "s" else 0,
    )


def _is_plain_number(table: TableFile, place: int | None) -> bool:
    return place is not None and any(row[place].isdigit() for row in table.dialect.sample)


def _time_unit(table: TableFile, columns: Columns, dated: bool) -> tuple[str | None, Origin]:
    if dated:
        return "ns", Origin.VALUES
    if table.given.time_units:
        return table.given.time_units[0], Origin.OPTION
    unit = columns.unit("time")
    return unit, Origin.NAME if unit else Origin.LAYOUT


def _from_increments(
    stamps: Stamps, push: FloatArray, turn: FloatArray, fields: FloatArray | None
) -> Samples:
    """Return mean force and rate (rad/s) over each sample from dv and the quaternion dq.

    A sample's increments belong to the usual interval, also after samples that were lost.
    """
    interval = float(np.median(np.diff(stamps.stamp_ns))) * 1e-9
    turn = turn * np.where(turn[:, :1] < 0.0, -1.0, 1.0)
    sine = np.linalg.norm(turn[:, 1:], axis=1)
    angle = 2.0 * np.arctan2(sine, turn[:, 0])
    scale = np.where(sine > 0.0, angle / np.where(sine > 0.0, sine, 1.0), 2.0)
    return Samples(stamps, push / interval, turn[:, 1:] * (scale / interval)[:, None], fields)


def _in_si(
    table: TableFile,
    columns: Columns,
    request: Request,
    samples: Samples,
    assumed: list[Assumption],
    increments: bool,
) -> Reading:
    force = told_unit(table.path, "force", columns, table.given, table.known)
    rate = told_unit(table.path, "rate", columns, table.given, table.known)
    if increments:
        force, rate = Told(force.unit or "m/s^2", force.origin), Told("rad/s", Origin.NAME)
    return in_si(table, columns, request, samples, assumed, (force, rate))


def in_si(
    table: TableFile,
    columns: Columns,
    request: Request,
    samples: Samples,
    assumed: list[Assumption],
    told: tuple[Told, Told],
) -> Reading:
    """Return samples in SI; ``told`` are the units of force and rate as they are told."""
    evidence = unit_evidence(samples.stamps.stamp_ns, samples.force, samples.rate)
    force, force_note = force_unit(table.path, request.foot, told[0], evidence)
    rate, rate_note = rate_unit(table.path, request.foot, told[1], evidence)
    units = {"force": force, "rate": rate}
    scale = request.field_scale
    fields, about = field_in_tesla(table, columns, samples.field, request.foot, scale)
    series = ImuSeries(
        samples.stamps.stamp_ns,
        samples.force * FORCE_UNITS[force],
        samples.rate * RATE_UNITS[rate],
        fields,
        table.layout.increments,
    )
    wraps = table.layout.wrap_bits > 0
    stamps = samples.stamps
    found = (*table.form(request.foot), stamps.assumption, *assumed, force_note, rate_note, *about)
    layout = _found_layout(table, columns, stamps, units)
    return Reading(series, found, layout, "", wraps, table.facts)


def _found_layout(
    table: TableFile, columns: Columns, stamps: Stamps, units: Mapping[str, str]
) -> Layout:
    """Return everything that was found, as a layout for the next file of the kind."""
    dialect, layout = table.dialect, table.layout
    names = dialect.names
    named = {
        role: names[place] if names and names.count(names[place]) == 1 else str(place + 1)
        for role, place in columns.places.items()
    }
    return replace(
        layout,
        columns=layout.columns if layout.parts else named,
        delimiter=dialect.delimiter,
        decimal=dialect.decimal,
        time_units=layout.time_units if stamps.unit is None else (stamps.unit,),
        rate_hz=stamps.rate_hz,
        force_unit=units["force"],
        rate_unit=units["rate"],
    )


def read_stream(
    table: TableFile, columns: Columns, quantity: str, foot: str, rows: BoolArray | None = None
) -> tuple[Stream, Stamps]:
    """Return one vector of a table, of the rows that have it, with stamps of its own."""
    places = columns.vector(quantity)
    if places is None:
        raise RecordingError(missing(table.path, table.dialect, columns, table.facts))
    cells = table.numbers(places)
    keep = _kept(cells.empty, rows) & table.timed(columns.places.get("time"))
    table.check_filled(places, keep)
    stamps = stamps_of(time_source(table, columns, foot, keep))
    return Stream(stamps.stamp_ns, cells.numbers[keep]), stamps
