"""The plain-C epoch of the same filter, compiled here: one C is its CPU time for both feet."""

from __future__ import annotations

import importlib.util
import shutil
import statistics
from pathlib import Path
from typing import Any

import numpy as np

from dualfoot_ros.core import ImuPair
from dualfoot_ros.core.samples.series import FloatArray, ImuSeries, stack_pairs

from ..cases import Walk

SOURCE, MODULE, COMPILER = "epoch.c", "yardstick.py", "gcc"
RATE_HZ = 200.0


class CEpoch:
    """The yardstick of a folder: its compiled epoch, and the walk that it makes.

    Raises
    ------
    FileNotFoundError
        When the folder does not hold the yardstick, or there is no C compiler.
    """

    def __init__(self, folder: Path, epochs: int) -> None:
        for needed in (SOURCE, MODULE):
            if not (folder / needed).exists():
                raise FileNotFoundError(f"'{folder}' has no {needed}")
        if shutil.which(COMPILER) is None:
            raise FileNotFoundError(f"there is no C compiler here ({COMPILER})")
        module = _load(folder / MODULE)
        self.samples: FloatArray = module.walk(epochs)
        self.walk = _to_walk(module, self.samples)
        self._compiled = module.Yardstick()
        self.us()  # the first run fetches the code

    def us(self) -> float:
        """Return the CPU time of an epoch now, us: the median of three runs."""
        return statistics.median(self._compiled.us_per_epoch(self.samples) for _ in range(3))


def _load(path: Path) -> Any:
    spec = importlib.util.spec_from_file_location("c_yardstick", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _to_walk(module: Any, samples: FloatArray) -> Walk:
    stamps, left, right = module.feet(samples)
    feet = ImuSeries(stamps, *left), ImuSeries(stamps, *right)
    values = np.ascontiguousarray(stack_pairs(*feet))
    pairs = [ImuPair(int(s), v) for s, v in zip(stamps, values, strict=True)]
    return Walk(*feet, pairs, RATE_HZ)
