"""Sensors at rest, made up: known errors, known attitudes."""

import numpy as np

from dualfoot_ros.calibration.static import segments_of
from dualfoot_ros.core import ImuSeries

GRAVITY = 9.80665
RATE_HZ = 60.0
SIX = np.vstack([np.eye(3), -np.eye(3)])


def resting(up, seconds=5.0, *, bias=(0, 0, 0), matrix=None, gyro=(0, 0, 0), noise=0.01, seed=0):
    """Return what a sensor reads whose axes see ``up`` (3,) upwards.

    ``matrix`` and ``bias`` are those of the correction, so the reading is inv(matrix) f + bias.
    """
    rng = np.random.default_rng(seed)
    count = round(seconds * RATE_HZ)
    up = np.asarray(up, dtype=float) / np.linalg.norm(up)
    true = GRAVITY * up
    sensed = np.linalg.solve(np.eye(3) if matrix is None else matrix, true) + bias
    return ImuSeries(
        10**18 + np.arange(count) * round(1e9 / RATE_HZ),
        sensed + noise * rng.standard_normal((count, 3)),
        np.asarray(gyro) + 0.001 * rng.standard_normal((count, 3)),
    )


def moving(seconds=3.0, seed=0):
    """Return a sensor that is being turned over by hand."""
    rng = np.random.default_rng(seed)
    count = round(seconds * RATE_HZ)
    stamps = 10**18 + np.arange(count) * round(1e9 / RATE_HZ)
    return ImuSeries(stamps, rng.normal(0, 8, (count, 3)), rng.normal(0, 2, (count, 3)))


def joined(*parts):
    """Return the parts one after the other."""
    count = sum(len(p) for p in parts)
    return ImuSeries(
        10**18 + np.arange(count) * round(1e9 / RATE_HZ),
        np.vstack([p.specific_force for p in parts]),
        np.vstack([p.angular_rate for p in parts]),
    )


def segments(ups, **errors):
    """Return one standstill for each direction of ``ups`` (K, 3)."""
    series = [resting(up, seed=k, **errors) for k, up in enumerate(ups)]
    return [s for k, each in enumerate(series) for s in segments_of(each, f"{k}")]


def well_spread(count, seed=0):
    """Return unit vectors (count, 3): the six sides, the corners and edges, then at random."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    edges = np.array([[1, 1, 0], [1, 0, 1], [0, 1, 1], [-1, 1, 0], [-1, 0, 1], [0, -1, 1]])
    random = np.random.default_rng(seed).standard_normal((count, 3))
    all_ = np.vstack([SIX, corners, edges, random])[:count].astype(float)
    return all_ / np.linalg.norm(all_, axis=1)[:, None]


def export(path, series):
    """Write a series as the Xsens DOT app does."""
    rows = ["sep=,", "DeviceTag:,A", "", "PacketCounter,SampleTimeFine,"]
    rows[-1] += ",".join(f"{g}_{a}" for g in ("Acc", "Gyr") for a in "XYZ")
    table = np.hstack([series.specific_force, np.degrees(series.angular_rate)])
    for k, (stamp, row) in enumerate(zip(series.stamp_ns, table, strict=True)):
        us = (int(stamp) // 1000) % 2**32
        rows.append(f"{k},{us}," + ",".join(f"{v:.9f}" for v in row))
    path.write_text("\n".join(rows) + "\n")
    return path
