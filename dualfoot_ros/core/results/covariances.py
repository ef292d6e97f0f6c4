"""Covariances of a whole walk, kept in two thirds of the memory of their matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from ..samples.series import BoolArray, FloatArray, IntArray

UPPER = (0, 1, 2, 4, 5, 8)  # cells of a row-major 3x3 matrix on and above its diagonal
CELLS = (0, 1, 2, 1, 3, 4, 2, 4, 5)  # where each cell of a symmetric one stands among these


class Covariances(NDArrayOperatorsMixin):
    """Covariances (N, 3, 3), which are arrays to whoever indexes them or calculates with them.

    Those of the kernel are symmetric to the bit, so their upper triangles hold them.  Matrices
    that a turn has been through are not (it rounds the two triangles differently): the rows up to
    the newest turn are kept whole.
    """

    def __init__(
        self, whole: FloatArray, triangles: FloatArray, rotation: FloatArray | None = None
    ) -> None:
        """Hold the matrices (H, 3, 3), then those with upper triangles (N - H, 6).

        All of them are turned by ``rotation`` (3, 3) when they are looked at.
        """
        self._whole, self._triangles, self._rotation = whole, triangles, rotation

    @classmethod
    def of(cls, matrices: FloatArray | Covariances) -> Covariances:
        """Return matrices (N, 3, 3), symmetric or not, as covariances of a walk."""
        if isinstance(matrices, Covariances):
            return matrices
        return cls(matrices, np.empty((0, len(UPPER))))

    @classmethod
    def unknown(cls, count: int) -> Covariances:
        """Return so many matrices of nan, in next to no memory."""
        return cls.of(np.broadcast_to(np.nan, (count, 3, 3)))

    def __len__(self) -> int:
        """Return the number of matrices."""
        return len(self._whole) + len(self._triangles)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of the array of all."""
        return (len(self), 3, 3)

    def cut(self, keep: BoolArray | slice) -> Covariances:
        """Return those that a mask (N,) or a slice of neighbours keeps."""
        count = len(self._whole)
        if isinstance(keep, slice):
            first, last, _ = keep.indices(len(self))
            whole = self._whole[first:last]
            rest = self._triangles[max(first - count, 0) : max(last - count, 0)]
        else:
            whole, rest = self._whole[keep[:count]], self._triangles[keep[count:]]
        return Covariances(whole, rest, self._rotation)

    def turned(self, rotation: FloatArray) -> Covariances:
        """Return them turned by a rotation (3, 3); nothing is calculated yet."""
        if self._rotation is not None:
            return Covariances.of(_turn(np.asarray(self), rotation))
        return Covariances(self._whole, self._triangles, rotation)

    def only(self, epochs: IntArray) -> FewCovariances:
        """Return those of some epochs (K,), in order; nan takes the place of the others."""
        return FewCovariances(len(self), epochs, Covariances.of(self[epochs]))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Return all of them, (N, 3, 3)."""
        count = len(self._whole)
        matrices = np.empty(self.shape, dtype=dtype)
        matrices[:count] = self._whole
        np.take(self._triangles, CELLS, 1, matrices.reshape(-1, 9)[count:], mode="clip")
        return matrices if self._rotation is None else _turn(matrices, self._rotation)

    def __getitem__(self, key: Any) -> FloatArray:
        """Return what the same index takes from the array of all; only those rows are made."""
        first, rest = (key[0], key[1:]) if isinstance(key, tuple) else (key, ())
        if isinstance(first, slice) and first.step in (None, 1):
            rows = np.asarray(self.cut(first))
        else:
            rows = self._picked(np.arange(len(self))[first])
        found: FloatArray = rows[(..., *(slice(None),) * (2 - len(rest)), *rest)]
        return found

    def _picked(self, at: Any) -> FloatArray:
        """Return the matrices (..., 3, 3) of epochs ``at``, of any shape."""
        count, at = len(self._whole), np.asarray(at)
        matrices = np.empty((*at.shape, 3, 3))
        early = at < count
        matrices[early] = self._whole[at[early]]
        rest = self._triangles[at[~early] - count][:, CELLS]
        matrices[~early] = rest.reshape(-1, 3, 3)
        return matrices if self._rotation is None else _turn(matrices, self._rotation)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Calculate with the array of all."""
        arrays = [np.asarray(x) if isinstance(x, Covariances) else x for x in inputs]
        return getattr(ufunc, method)(*arrays, **options)


class FewCovariances(Covariances):
    """Covariances of a walk of which only those of some epochs are known; the others are nan."""

    def __init__(self, count: int, epochs: IntArray, known: Covariances) -> None:
        """Hold those ``known`` at epochs (K,), in order, of ``count``."""
        self._count, self._epochs, self._known = count, epochs, known

    def __len__(self) -> int:
        """Return the number of matrices."""
        return self._count

    def cut(self, keep: BoolArray | slice) -> Covariances:
        """Return those that a mask (N,) or a slice of neighbours keeps."""
        places = np.full(self._count, -1)
        kept = np.arange(self._count)[keep]
        places[kept] = np.arange(len(kept))
        still = places[self._epochs] >= 0
        return FewCovariances(len(kept), places[self._epochs[still]], self._known.cut(still))

    def turned(self, rotation: FloatArray) -> Covariances:
        """Return them turned by a rotation (3, 3)."""
        return FewCovariances(self._count, self._epochs, self._known.turned(rotation))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Return all of them, (N, 3, 3)."""
        return self._picked(np.arange(self._count)).astype(dtype or float, copy=False)

    def _picked(self, at: Any) -> FloatArray:
        """Return the matrices (..., 3, 3) of epochs ``at``, of any shape."""
        matrices = np.full((*np.shape(at), 3, 3), np.nan)
        if len(self._epochs):
            place = np.minimum(np.searchsorted(self._epochs, at), len(self._epochs) - 1)
            known = self._epochs[place] == at
            matrices[known] = self._known[place[known]]
        return matrices


def _turn(matrices: FloatArray, rotation: FloatArray) -> FloatArray:
    turned: FloatArray = rotation @ matrices @ rotation.T
    return turned
