"""What a trajectory keeps of the kernel's output rows: half of their memory."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..kernel import layout as lay
from ..samples.large_arrays import new_array
from ..samples.series import BoolArray, FloatArray, IntArray
from .covariances import CELLS, UPPER, Covariances
from .events import FEET, Event
from .rows import clean_stance, turn_covariances, turn_nominal, zupt_nis
from .trajectory import FootTrajectory, Trajectory

NOMINAL = lay.KEPT  # position, velocity and quaternion stand side by side
OF_FOOT = (lay.O_COV_POS, lay.O_COV_VEL, lay.O_COV_ATT)
BLOCKS = (*OF_FOOT, *(lay.O_FOOT + block for block in OF_FOOT), lay.O_RELATIVE)
TRIANGLES = tuple(np.array([block + cell for cell in UPPER]) for block in BLOCKS)
CELLS_OF_ALL = len(CELLS) * len(BLOCKS)


class RowStore:
    """Rows that the kernel writes, turned when a heading becomes known, and read by columns."""

    def __init__(self, count: int, covariances: bool = True) -> None:
        """Make room for ``count`` rows, with ``covariances`` or without."""
        self._count, self._with_covariances = count, covariances
        self._nominal = [new_array((count, NOMINAL)) for _ in range(2)]
        self._present = np.zeros((count, 2), dtype=bool)
        self._nis = new_array((count, 2))
        kept = len(TRIANGLES) if covariances else 0  # apart: each can be let go by itself
        self._triangles = [new_array((count, len(UPPER))) for _ in range(kept)]
        self._turned = np.empty((0, CELLS_OF_ALL))  # covariances of the rows that were turned
        self._newest, self._heading_std = -1, math.nan  # of the newest row, which no turn changes

    @property
    def arrays(self) -> tuple[Any, ...]:
        """What the kernel is given to write rows to."""
        unused = [np.empty((0, len(UPPER)))] * (len(TRIANGLES) - len(self._triangles))
        flags = math.nan, int(self._with_covariances)
        return *self._nominal, self._nis, *flags, *self._triangles, *unused

    def written(self, span: slice, present: BoolArray, heading_variances: Sequence[float]) -> bool:
        """Take note of rows that the kernel has written; return whether all are numbers.

        ``present`` (K, 2) is which foot had samples, ``heading_variances`` those of the newest
        row, of the feet that are there, rad^2.
        """
        self._present[span] = present
        self._take_newest(span.stop - 1, heading_variances)
        arrays = *self._nominal, *self._triangles
        return all(_are_numbers(array[span].reshape(-1)) for array in arrays)

    def put(self, places: list[int], rows: FloatArray) -> None:
        """Take output rows (K, OUT) for places that no turn has reached."""
        self._put_nominal(places, rows)
        for foot in range(2):
            self._present[places, foot] = rows[:, foot * lay.O_FOOT + lay.O_PRESENT] > 0.0
        self._nis[places] = zupt_nis(rows)
        for triangles, cells in zip(self._triangles, TRIANGLES, strict=False):
            triangles[places] = np.take(rows, cells, axis=1)
        self._take_newest(places[-1], _heading_variances(rows[-1]))

    def _take_newest(self, place: int, heading_variances: Sequence[float]) -> None:
        if place >= self._newest:
            stds = [math.sqrt(max(variance, 0.0)) for variance in heading_variances]
            self._newest, self._heading_std = place, sum(stds) / len(stds) if stds else math.nan

    def turn(self, count: int, event: Event) -> None:
        """Turn the first ``count`` rows as a HEADING event says."""
        turn, foot = event.turn, FEET.index(event.foot)
        turn_nominal(self._nominal[foot][:count], turn)
        if self._with_covariances:
            self._make_whole(count)
            starts = range(0, CELLS_OF_ALL, len(CELLS))
            blocks = [self._turned[:count, start : start + len(CELLS)] for start in starts]
            own = blocks[len(OF_FOOT) * foot : len(OF_FOOT) * (foot + 1)]
            turn_covariances(own, blocks[-1], turn, foot)

    def _put_nominal(self, places: list[int], rows: FloatArray) -> None:
        for foot, nominal in enumerate(self._nominal):
            nominal[places] = rows[:, foot * lay.O_FOOT : foot * lay.O_FOOT + NOMINAL]

    def _make_whole(self, count: int) -> None:
        """Have whole matrices of the first rows, as a turn leaves no symmetric ones."""
        first = len(self._turned)
        if count > first:
            more = [triangles[first:count, CELLS] for triangles in self._triangles]
            self._turned = np.concatenate([self._turned, np.hstack(more)])

    def _covariances(self, number: int) -> Covariances:
        """Return the covariances of one of BLOCKS, nan where they are not kept."""
        if not self._with_covariances:
            return Covariances.unknown(self._count)
        whole = self._turned[:, 9 * number : 9 * number + 9].reshape(-1, 3, 3)
        return Covariances(whole, self._triangles[number][len(whole) :])

    def trajectory(
        self,
        stamps: IntArray,
        keep: BoolArray | slice,
        events: tuple[Event, ...],
        counters: Mapping[str, int],
        method: str,
    ) -> Trajectory:
        """Return the trajectory of the rows that are kept, with their stamps (M,)."""
        left, right = (self._foot(foot, stamps, keep, events) for foot in range(2))
        relative = self._covariances(len(BLOCKS) - 1).cut(keep)
        start = int(stamps[0]) if len(stamps) else 0
        nis = self._nis[keep]
        return Trajectory(
            left,
            right,
            relative,
            events,
            dict(counters),
            start,
            method,
            nis,
            self._heading_std,
        )

    def _foot(
        self, foot: int, stamps: IntArray, keep: BoolArray | slice, events: tuple[Event, ...]
    ) -> FootTrajectory:
        nominal, first = self._nominal[foot][keep], len(OF_FOOT) * foot
        return FootTrajectory(
            stamps,
            nominal[:, lay.O_POS : lay.O_POS + 3],
            nominal[:, lay.O_VEL : lay.O_VEL + 3],
            nominal[:, lay.O_QUAT : lay.O_QUAT + 4],
            clean_stance(stamps, events, foot),
            self._covariances(first).cut(keep),
            self._covariances(first + 1).cut(keep),
            self._covariances(first + 2).cut(keep),
            self._present[keep, foot],
        )


def _heading_variances(row: FloatArray) -> list[float]:
    """Return the variances of the headings in an output row, of the feet that are there, rad^2."""
    starts = [foot * lay.O_FOOT for foot in range(2) if row[foot * lay.O_FOOT + lay.O_PRESENT] > 0]
    return [float(row[start + lay.O_COV_ATT + 8]) for start in starts]


def _are_numbers(values: FloatArray) -> bool:
    """Return whether all values (N,) are numbers: then nearly always their sum is one."""
    with np.errstate(all="ignore"):
        return math.isfinite(values.sum()) or bool(np.isfinite(values).all())
