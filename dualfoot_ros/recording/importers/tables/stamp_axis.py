"""Stamps of the samples: from a time in any unit, from a counter, or from the rate alone.

The unit of a time is the one in which the sampling rate is possible, unless it is told; then it
is checked in the same way.  A time that a spreadsheet has rounded is rebuilt from the counter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ....core import FloatArray, IntArray, RecordingError
from ..sample_counter import bits_of, counts_samples, unwrapped
from .assumptions import Assumption, Origin
from .unit_words import SAMPLES, TIME_UNITS

LEAST_RATE, MOST_RATE = 8.0, 6000.0
LIKELY_RATE = (10.0, 2000.0)  # Hz; units are a factor of 1000 apart, so one of them fits
SAME_RATE = 1.1  # factor between the rate of the stamps and that of the header
TICKS, TICK_NS = "100us", 100_000
UNSORTED = 0.2  # of the steps; with more that go back the rows are in disorder
USUAL_RATE = (45.0, 800.0)  # Hz; beyond it, a unit that only the values tell deserves a look
REPEATED = 0.2  # of the stamps; with more equal ones the time was rounded
RATE_ERROR = 1e-3  # of the rate, where it is found from a time that was rounded


@dataclass(frozen=True)
class TimeSource:
    """What a table tells about time.

    Attributes
    ----------
    path, foot, name : the file, the foot it is of, the column of the time
    count : N, the number of samples
    values : (N,) the time as it stands, or None
    exact : (N,) the same as whole numbers, where a float does not hold them
    counter : (N,) the count of samples, or None
    unit : the unit that is told, and by whom
    allowed : units to choose from, where the layout tells
    rate_hz : the rate that is told, and by whom
    wrap_bits : bits of the device's counter, 0 for a time that does not wrap
    """

    path: Path
    foot: str
    name: str
    count: int
    values: FloatArray | None
    exact: IntArray | None
    counter: FloatArray | None
    unit: str | None
    unit_origin: Origin
    allowed: Sequence[str]
    rate_hz: float | None
    rate_origin: Origin
    wrap_bits: int


@dataclass(frozen=True)
class Stamps:
    """Stamps (N,) in ns, the assumption about them, and the unit or rate they were made with."""

    stamp_ns: IntArray
    assumption: Assumption
    unit: str | None = None
    rate_hz: float | None = None


def stamps_of(source: TimeSource) -> Stamps:
    """Return the stamps of the samples.

    Raises
    ------
    RecordingError
        When there is no time, or the time cannot be right; says what to give.
    """
    values = source.values
    if values is None or source.unit == SAMPLES or not np.isfinite(values).any():
        return _from_counts(source)
    _check_order(source, values)
    unit, origin = _unit(source, values)
    if unit is None:
        return _from_counts(source)
    stamps = _to_ns(source, values, TIME_UNITS[unit])
    if _is_rounded(stamps):
        return _rebuilt(source, stamps)
    if _disagrees(source, stamps):
        return _from_counts(source)
    rate_hz = _check_rate(source, stamps, unit)
    usual = USUAL_RATE[0] <= rate_hz <= USUAL_RATE[1]
    doubtful = origin is Origin.VALUES and not usual
    value = f"{source.name}, in {unit}"
    if doubtful:
        value += f", which gives {rate_hz:.4g} Hz; if that is wrong, give --time-unit"
    stamps = _without_ticks(stamps, TICK_NS) if unit == TICKS else stamps
    return Stamps(stamps, Assumption(source.foot, "time", value, origin, doubtful), unit)


def _without_ticks(stamps: IntArray, tick_ns: int) -> IntArray:
    """Return even stamps where rounding to ticks is all that makes them uneven, else the same.

    At 60 Hz, ticks of 0.1 ms have steps of 166 and 167, and their median is 0.2 % off.
    """
    steps = np.diff(stamps)
    counts = np.rint(steps / np.median(steps))
    if not (counts >= 1.0).all():
        return stamps
    index = np.concatenate(([0.0], np.cumsum(counts)))
    even = index * ((stamps[-1] - stamps[0]) / index[-1])
    rest = stamps - stamps[0] - even
    if np.ptp(rest) > 2 * tick_ns:
        return stamps
    middle = max(0, round(float(rest.max() + rest.min()) / 2.0))  # no stamp gets below zero
    return np.asarray(stamps[0] + np.int64(middle) + np.rint(even).astype(np.int64))


def _check_order(source: TimeSource, values: FloatArray) -> None:
    """Refuse rows in disorder; a counter that wraps goes back now and then only."""
    steps = np.diff(values[np.isfinite(values)])
    back = int((steps < 0.0).sum())
    if len(steps) > 1 and back > UNSORTED * len(steps):
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' goes back in {back} of "
            f"{len(steps)} steps; sort the rows by time, or give another column with --columns "
            "time=NAME, or the sampling rate with --rate HZ"
        )


def _disagrees(source: TimeSource, stamps: IntArray) -> bool:
    """Return whether the user gives another rate than the stamps have."""
    if source.rate_hz is None or source.rate_origin is not Origin.OPTION:
        return False
    ratio = source.rate_hz * _usual_step(stamps.astype(np.float64)) * 1e-9
    return not 1.0 / SAME_RATE < ratio < SAME_RATE


def _unit(source: TimeSource, values: FloatArray) -> tuple[str | None, Origin]:
    """Return name and origin of the unit of the time; None where only a given rate helps."""
    step = _usual_step(values)
    told = source.unit
    if told is not None and (source.unit_origin is Origin.OPTION or not source.allowed):
        return told, source.unit_origin
    allowed = [told] if told is not None else list(source.allowed or ("s", "ms", "us", "ns"))
    allowed += [unit for unit in source.allowed if unit not in allowed]
    if source.rate_hz is not None and step > 0.0:
        for unit in allowed:
            ratio = source.rate_hz * step * TIME_UNITS[unit]
            if 1.0 / SAME_RATE < ratio < SAME_RATE:
                return unit, Origin.HEADER if told is None else source.unit_origin
    for unit in allowed:
        if step > 0.0 and LIKELY_RATE[0] <= 1.0 / (step * TIME_UNITS[unit]) < LIKELY_RATE[1]:
            origin = source.unit_origin if unit == told else Origin.VALUES
            return unit, origin
    if told is not None or source.allowed:
        return allowed[0], source.unit_origin
    if source.rate_hz is not None and source.rate_origin is Origin.OPTION:
        return None, Origin.OPTION
    raise RecordingError(
        f"'{source.path}': the time in column '{source.name}' is in no known unit (usual step "
        f"{step:.6g}); give --time-unit s, ms, us, ns or samples, or --rate HZ"
    )


def _usual_step(values: FloatArray) -> float:
    """Return the median step, or the mean one of a time that was rounded."""
    values = values[np.isfinite(values)]
    steps = np.diff(values)
    later = steps[steps > 0.0]
    if not len(later):
        return 0.0
    rounded = float((steps == 0.0).mean()) > REPEATED
    return float(values[-1] - values[0]) / len(steps) if rounded else float(np.median(later))


def _to_ns(source: TimeSource, values: FloatArray, size: float) -> IntArray:
    if source.exact is not None:
        return (source.exact * round(size * 1e9)).astype(np.int64)
    if source.wrap_bits and np.all(np.abs(values) < 2.0**source.wrap_bits):
        counts = unwrapped(values, source.wrap_bits)
        return counts * np.int64(round(size * 1e9))
    beyond = np.flatnonzero(~(np.abs(values * size) < float(2**33)))
    if len(beyond):
        few = len(beyond) < REPEATED * len(values)
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' is out of range "
            f"({values[beyond[0]]:.6g} in sample {beyond[0] + 1}, {len(beyond)} of {len(values)} "
            f"samples); {'remove these rows' if few else 'give --time-unit'}"
        )
    whole = np.floor(values * size)
    rest = np.where(np.isfinite(values), values * size - whole, 0.0)
    return whole.astype(np.int64) * 1_000_000_000 + np.rint(rest * 1e9).astype(np.int64)


def _is_rounded(stamps: IntArray) -> bool:
    steps = np.diff(stamps)
    return len(steps) > 1 and float((steps == 0).mean()) > REPEATED


def _check_rate(source: TimeSource, stamps: IntArray, unit: str) -> float:
    """Return the sampling rate, Hz, if it can be one."""
    steps = np.diff(stamps)
    steps = steps[steps > 0]
    if not len(steps):
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' does not increase; give the "
            "column of the time with --columns time=NAME, or --rate HZ"
        )
    rate = 1e9 / float(np.median(steps))
    if not LEAST_RATE <= rate <= MOST_RATE:
        likely = [
            f"{1e-9 * rate * TIME_UNITS[unit] / size * 1e9:.4g} Hz in {other}"
            for other, size in TIME_UNITS.items()
            if LIKELY_RATE[0] <= rate * TIME_UNITS[unit] / size < LIKELY_RATE[1]
        ]
        hint = f"; it would be {' or '.join(likely)}" if likely else ""
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' in {unit} means {rate:.4g} Hz, "
            f"which cannot be{hint}; give the unit with --time-unit"
        )
    return rate


def _from_counts(source: TimeSource) -> Stamps:
    """Return stamps from the counter (or the rows) and the rate."""
    rate = source.rate_hz
    if rate is None:
        raise RecordingError(
            f"'{source.path}' has no column of the time, and no rate is told; give the column "
            "with --columns time=NAME, or the sampling rate with --rate HZ"
        )
    if not LEAST_RATE <= rate <= MOST_RATE:
        raise RecordingError(
            f"'{source.path}': a rate of {rate:g} Hz cannot be; allowed is {LEAST_RATE:g} to "
            f"{MOST_RATE:g} Hz"
        )
    counts, what = _counts(source)
    stamps = np.rint((counts - counts[0]) * (1e9 / rate)).astype(np.int64)
    value = f"{what}, at {rate:g} Hz"
    unit = SAMPLES if source.unit == SAMPLES else None
    return Stamps(stamps, Assumption(source.foot, "time", value, source.rate_origin), unit, rate)


def _counts(source: TimeSource) -> tuple[IntArray, str]:
    """Return the count of each sample: its counter without wraps, or the number of its row."""
    values = source.values if source.unit == SAMPLES else source.counter
    if values is not None and np.isfinite(values).all() and counts_samples(values):
        return unwrapped(values, bits_of(values)), "count of the samples"
    return np.arange(source.count, dtype=np.int64), "number of the row"


def _rebuilt(source: TimeSource, stamps: IntArray) -> Stamps:
    """Return stamps for a time that was rounded, from the counter."""
    steps = np.diff(stamps)
    rounding = float(steps[steps > 0].min()) * 1e-9 if (steps > 0).any() else 0.0
    shared = float((steps == 0).mean())
    counter = source.counter
    if counter is None or not np.isfinite(counter).all() or not counts_samples(counter):
        if source.rate_hz is not None and source.rate_origin is Origin.OPTION:
            return _from_counts(source)
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' was rounded ({shared:.0%} of "
            f"the samples share the stamp of the one before, a step is {rounding:g} s), as "
            "spreadsheets do, and there is no counter to rebuild it from; export again, or give "
            "the sampling rate with --rate HZ"
        )
    counts = unwrapped(counter, bits_of(counter))
    rate = source.rate_hz or _rate_of(stamps, counts, rounding, source)
    rebuilt = stamps[0] + np.rint((counts - counts[0]) * (1e9 / rate)).astype(np.int64)
    value = (
        f"rebuilt from the counter at {rate:.6g} Hz ({source.name} was rounded to {rounding:g} s)"
    )
    return Stamps(rebuilt, Assumption(source.foot, "time", value, Origin.VALUES, doubtful=True))


def _rate_of(stamps: IntArray, counts: IntArray, rounding: float, source: TimeSource) -> float:
    span_s = float(stamps[-1] - stamps[0]) * 1e-9
    # The slope of a line through N rounded stamps is right within rounding / (span sqrt(N)).
    error = rounding / (span_s * float(np.sqrt(len(stamps)))) if span_s > 0.0 else 1.0
    if error > RATE_ERROR:
        raise RecordingError(
            f"'{source.path}': the time in column '{source.name}' was rounded to {rounding:g} s, "
            "too coarse to tell the sampling rate; give it with --rate HZ"
        )
    slope = np.polyfit((counts - counts[0]).astype(float), (stamps - stamps[0]) * 1e-9, 1)[0]
    return 1.0 / float(slope)
