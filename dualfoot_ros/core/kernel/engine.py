"""The entry points of the kernel, and its plain form: interpreted Python.

The compiled form is made from the same function objects in :mod:`dualfoot_ros.core.compiler`.
"""

from __future__ import annotations

import inspect
import types
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from . import (
    closest,
    covariance,
    detector,
    epoch,
    floor,
    measurement_update,
    stance_correction,
    strapdown,
    tiles,
    turn,
    zero_velocity,
)
from . import layout as lay
from .at_stances import (
    distance_constraint,
    landing,
    observation,
    separation,
    spacing_constraint,
    spacing_learner,
    stance_end,
)
from .outputs import kept_row, output_row
from .schmidt import considered_states, considered_update, known_states, stance_gain

STAMPS = np.iinfo(np.int64)  # that the library takes
MODULES = (
    closest,
    strapdown,
    tiles,
    covariance,
    considered_states,
    known_states,
    considered_update,
    stance_gain,
    measurement_update,
    stance_correction,
    zero_velocity,
    detector,
    floor,
    output_row,
    kept_row,
    epoch,
    turn,
    separation,
    observation,
    spacing_constraint,
    distance_constraint,
    spacing_learner,
    landing,
    stance_end,
)
ENTRIES = (
    "advance",
    "keep",
    "step",
    "take_pair",
    "rerun",
    "restore",
    "set_flags",
    "emit",
    "tell",
    "collect",
    "correct",
    "turn",
    "closest",
    "observe",
    "constrain_spacing",
    "constrain_distance",
    "distance_after",
    "learn_spacing",
    "end_stance",
    "landing",
)


class Engine(NamedTuple):
    """The kernel's entry points in one of the two forms."""

    name: str
    advance: Callable[..., Any]
    keep: Callable[..., Any]
    step: Callable[..., Any]
    take_pair: Callable[..., Any]
    rerun: Callable[..., Any]
    restore: Callable[..., Any]
    set_flags: Callable[..., Any]
    emit: Callable[..., Any]
    tell: Callable[..., Any]
    collect: Callable[..., Any]
    correct: Callable[..., Any]
    turn: Callable[..., Any]
    closest: Callable[..., Any]
    observe: Callable[..., Any]
    constrain_spacing: Callable[..., Any]
    constrain_distance: Callable[..., Any]
    distance_after: Callable[..., Any]
    learn_spacing: Callable[..., Any]
    end_stance: Callable[..., Any]
    landing: Callable[..., Any]


def kernel_functions() -> dict[str, types.FunctionType]:
    """Return every function of the kernel by name."""
    return {
        name: item
        for module in MODULES
        for name, item in vars(module).items()
        if inspect.isfunction(item) and item.__module__ == module.__name__
    }


@cache
def interpreted() -> Engine:
    """Return the kernel as plain Python functions."""
    functions = kernel_functions()
    entries: dict[str, Callable[..., Any]] = {name: functions[name] for name in ENTRIES}
    return Engine("interpreted", **{**entries, "take_pair": looked_at(entries["take_pair"])})


def looked_at(take_pair: Callable[..., int]) -> Callable[..., int]:
    """Return ``take_pair`` so that it looks first at what is from outside, as the library does."""

    def take_if_plain(w: Any, n: Any, ring_stamps: Any, stamp: int, sample: Any, told: Any) -> int:
        if not STAMPS.min <= stamp <= STAMPS.max or not is_plain(sample):
            return lay.NOT_TAKEN
        return take_pair(w, n, ring_stamps, stamp, sample, told)

    return take_if_plain


def is_plain(sample: Any) -> bool:
    """Return whether a sample is an array of 12 float64 that lie one after the other."""
    return (
        type(sample) is np.ndarray
        and sample.dtype == np.float64
        and sample.shape == (12,)
        and sample.flags.c_contiguous
        and sample.flags.aligned
    )
