"""The first standstill is the same however many windows are looked at at once."""

import numpy as np
import pytest

from dualfoot_ros.core import ImuSeries
from dualfoot_ros.inspection import standstill
from dualfoot_ros.inspection.standstill import first_stand

SAMPLES = 8000
PERIOD_NS = 5_000_000


def resting(*spans: tuple[int, int]) -> ImuSeries:
    """Return a sensor that moves, but for spans of samples."""
    rng = np.random.default_rng(1)
    force, rate = rng.normal(size=(2, SAMPLES, 3))
    for first, last in spans:
        force[first:last] *= 0.01
        rate[first:last] *= 0.001
    return ImuSeries(np.arange(SAMPLES) * PERIOD_NS, force, rate)


@pytest.mark.parametrize(
    "spans",
    [
        [(0, 900)],
        [(0, SAMPLES)],
        [(SAMPLES - 900, SAMPLES)],
        [(300, 360), (2500, 5500)],
        [(1500, 2500), (4000, 6000)],
    ],
)
def test_the_standstill_does_not_depend_on_how_many_windows_are_looked_at(monkeypatch, spans):
    """Wherever it lies, and also where it goes on beyond those of a look; a short one is none."""
    series = resting(*spans)
    monkeypatch.setattr(standstill, "AT_FIRST", SAMPLES)
    at_once = vars(first_stand(series))
    monkeypatch.setattr(standstill, "AT_FIRST", 4)
    bit_by_bit = vars(first_stand(series))
    assert all(np.array_equal(at_once[name], bit_by_bit[name]) for name in at_once)
    first = max(spans, key=lambda span: span[1] - span[0]) if spans[0][0] == 300 else spans[0]
    assert at_once["start_s"] == pytest.approx(first[0] * PERIOD_NS * 1e-9, abs=0.75)  # a window


def test_what_follows_the_standstill_is_not_looked_at(monkeypatch):
    looked_at = []
    are_still = standstill._are_still
    monkeypatch.setattr(standstill, "AT_FIRST", 8)
    monkeypatch.setattr(
        standstill, "_are_still", lambda f, *rest: looked_at.append(len(f)) or are_still(f, *rest)
    )
    assert first_stand(resting((0, 500))) is not None
    assert looked_at == [8]
    assert first_stand(resting()) is None
    assert looked_at[1:] == [8, 8, 16, 21]  # all 53
