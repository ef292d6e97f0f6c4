"""Made-up exports: two feet that stand and walk, written in the layouts of makers and programs."""

import numpy as np

from dualfoot_ros.core import FORCE_UNITS, RATE_UNITS, ImuSeries

from ..samples import moving

FEET = ("left", "right")


def walk(count=900, stand=300, seed=1):
    """Return both feet: a stand of 3 s, then a walk, at 100 Hz, from 10 s on."""
    return {
        foot: moving(seed + k, count=count, stand=stand, start_ns=10_000_000_000)
        for k, foot in enumerate(FEET)
    }


def values(series, force_unit="m/s^2", rate_unit="rad/s"):
    """Return (N, 6): forces and rates in these units."""
    return np.hstack(
        [
            series.specific_force / FORCE_UNITS[force_unit],
            series.angular_rate / RATE_UNITS[rate_unit],
        ]
    )


def number(value, decimal="."):
    """Return a cell."""
    text = str(int(value)) if float(value).is_integer() and abs(value) > 1e5 else f"{value:.6f}"
    return text.replace(".", decimal)


def table(names, rows, *, delimiter=",", before=(), units=None, decimal=".", end="\n"):
    """Return a table as text: lines before the names, names, units, rows of cells or numbers."""
    lines = [*before, delimiter.join(names)]
    if units is not None:
        lines.append(delimiter.join(units))
    for row in rows:
        cells = (cell if isinstance(cell, str) else number(cell, decimal) for cell in row)
        lines.append(delimiter.join(cells))
    return end.join(lines) + end


def same(found: ImuSeries, expected: ImuSeries, *, step=1e-4, skip=0):
    """Assert that samples were read in SI, with intervals right within ``step`` s."""
    part = expected[slice(skip, skip + len(found))]
    assert len(found) >= len(expected) - 5
    np.testing.assert_allclose(found.specific_force, part.specific_force, atol=2e-4)
    np.testing.assert_allclose(found.angular_rate, part.angular_rate, atol=2e-4)
    np.testing.assert_allclose(
        np.diff(found.stamp_ns) * 1e-9, np.diff(part.stamp_ns) * 1e-9, atol=step
    )
