"""Height from pressure against the tables of ICAO Doc 7488, and the log of what was measured."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import PressureSeries, SeriesError
from dualfoot_ros.core.aids import PressureLog, height_pressure, pressure_height
from dualfoot_ros.core.aids.log import KEEP_NS

SECOND = 1_000_000_000
# Geopotential height (m) and pressure (Pa) of the International Standard Atmosphere.
TABLE = [
    (-1000.0, 113930.0),
    (0.0, 101325.0),
    (500.0, 95460.8),
    (1000.0, 89874.6),
    (2000.0, 79495.2),
    (3000.0, 70108.5),
    (5000.0, 54019.9),
    (8000.0, 35599.8),
    (11000.0, 22632.0),
]


@pytest.mark.parametrize(("height", "pascal"), TABLE)
def test_pressure_and_height_are_those_of_the_tables(height, pascal):
    assert height_pressure(height) == pytest.approx(pascal, rel=1e-4)
    assert pressure_height(pascal) == pytest.approx(height, abs=0.5)


@given(st.floats(1.1e4, 1.9e5), st.floats(1.1e4, 1.9e5))
def test_less_pressure_is_higher_up(one, other):
    low, high = max(one, other), min(one, other)
    assert pressure_height(high) >= pressure_height(low)
    if low - high > 1e-6:
        assert pressure_height(high) > pressure_height(low)


@given(st.floats(-1000.0, 11000.0))
def test_height_to_pressure_and_back_is_the_identity(height):
    assert pressure_height(height_pressure(height)) == pytest.approx(height, abs=1e-6)


@given(st.floats(-400.0, 5000.0))
def test_the_lapse_is_that_of_a_column_of_air_at_rest(height):
    """Hydrostatics: dp/dh = -g p / (R T), with T falling by 6.5 K/km."""
    step = 0.5
    slope = (height_pressure(height + step) - height_pressure(height - step)) / (2.0 * step)
    temperature = 288.15 - 0.0065 * height
    density = height_pressure(height) / (287.05287 * temperature)
    assert slope == pytest.approx(-9.80665 * density, rel=1e-4)


@pytest.mark.parametrize("pascal", [float("nan"), float("inf"), 0.0, -5.0, 1013.25, 3e5])
def test_what_is_no_air_pressure_in_pascal_is_refused_by_name(pascal):
    log = PressureLog()
    assert log.add(0, pascal) == "pressure_out_of_range"
    assert log.between(-SECOND, SECOND) == []


def test_a_stamp_that_does_not_follow_is_refused_by_name_and_leaves_no_trace():
    log = PressureLog()
    assert log.add(5 * SECOND, 101325.0) is None
    for stamp in (5 * SECOND, 5 * SECOND - 1, 4 * SECOND + 1):
        assert log.add(stamp, 90000.0) == "pressure_out_of_order"
    assert log.between(0, 9 * SECOND) == [pressure_height(101325.0)]


def test_a_stamp_from_long_before_begins_a_new_recording():
    log = PressureLog()
    log.add(100 * SECOND, 101325.0)
    assert log.add(10 * SECOND, 100000.0) is None
    assert log.between(0, 200 * SECOND) == [pressure_height(100000.0)]


@pytest.mark.parametrize("ahead_ns", [5 * SECOND, 10**16])
def test_one_stamp_from_the_future_costs_nothing_of_what_was_measured_before(ahead_ns):
    log, whole = PressureLog(), PressureLog()
    for k in range(20):
        for each in (log, whole):
            assert each.add(k * SECOND, 101325.0 - k) is None
            each.trim()
        if k == 10:
            assert log.add(k * SECOND + ahead_ns, 90000.0) is None
            log.trim()
    assert log.between(0, 10**18) == whole.between(0, 10**18)


@given(st.lists(st.integers(1, 10**10), min_size=1, max_size=40), st.data())
def test_between_returns_just_what_was_measured_then(steps, data):
    stamps = np.cumsum(steps).tolist()
    log = PressureLog()
    for k, stamp in enumerate(stamps):
        assert log.add(stamp, 90000.0 + k) is None
    first = data.draw(st.integers(0, stamps[-1]))
    last = data.draw(st.integers(0, stamps[-1]))
    inside = [pressure_height(90000.0 + k) for k, s in enumerate(stamps) if first <= s <= last]
    assert log.between(first, last) == inside


def test_a_log_that_is_trimmed_stays_small_and_keeps_the_last_minute():
    log, period = PressureLog(), SECOND // 25
    for k in range(25 * 600):
        log.add(k * period, 100000.0)
        log.trim()
    newest = (25 * 600 - 1) * period
    assert len(log.between(0, newest)) <= 2 * 25 * 60 + 1
    assert len(log.between(newest - KEEP_NS + 1, newest)) == 25 * 60


@pytest.mark.parametrize(
    ("stamps", "pressure"), [([1, 2], [1e5]), ([[1], [2]], [[1e5], [1e5]]), ([], [1e5])]
)
def test_a_series_whose_parts_do_not_fit_together_is_refused(stamps, pressure):
    with pytest.raises(SeriesError, match="allowed is"):
        PressureSeries(np.array(stamps), np.array(pressure))
