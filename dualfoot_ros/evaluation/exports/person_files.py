"""The person's track as TUM and as CSV."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from ...core import FloatArray, PoseSeries, new_array
from ..frames.association import seconds
from ..tracked_person import PersonTrack
from .text_table import Form, write_table
from .tum import write_tum

FORM = Form(places=0, decimals=6, separator=",")
COLUMNS = (
    "stamp_ns,time_s,x_m,y_m,z_m,floor_m,heading_deg,walked_m,radius_95_m,"
    "cov_xx_m2,cov_xy_m2,cov_yy_m2,cov_zz_m2"
)


def write_person(directory: Path, person: PersonTrack) -> list[Path]:
    """Write ``person.tum`` and ``person.csv``; return their paths.

    TUM has one line an epoch: ``seconds x y z qx qy qz qw``, the attitude being the heading alone.
    """
    pose = PoseSeries(person.stamp_ns, person.position, heading_quaternions(person.heading))
    tum = write_tum(directory / "person.tum", pose)
    return [tum, _write_csv(directory / "person.csv", person)]


def heading_quaternions(heading: FloatArray) -> FloatArray:
    """Return (N, 4) quaternions x y z w of headings (N,) rad."""
    quaternions = new_array((len(heading), 4))
    quaternions[:, 2], quaternions[:, 3] = np.sin(heading / 2), np.cos(heading / 2)
    return quaternions


def _write_csv(path: Path, person: PersonTrack) -> Path:
    with path.open("wb") as file:
        file.write(f"{COLUMNS}\n".encode())
        write_table(file, person.stamp_ns, partial(_values, person), FORM)
    return path


def _values(person: PersonTrack, rows: slice) -> FloatArray:
    """Return the columns behind the stamps (K, 12) of some epochs."""
    some = person.at(rows)
    c = some.covariance
    return np.column_stack(
        [
            seconds(some.stamp_ns, int(person.stamp_ns[0])),
            some.position,
            some.floor_m,
            np.degrees(some.heading),
            some.walked_m,
            some.radius_95_m,
            *(c[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1), (2, 2))),
        ]
    )
