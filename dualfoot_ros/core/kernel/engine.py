"""The entry points of the kernel, and its plain form: interpreted Python.

The compiled form is made from the same function objects in :mod:`dualfoot_ros.core.compiler`.
"""

from __future__ import annotations

import inspect
import types
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from . import (
    closest,
    covariance,
    detector,
    epoch,
    floor,
    measurement_update,
    output_row,
    stance_correction,
    strapdown,
    tiles,
    turn,
    zero_velocity,
)
from .at_stances import (
    distance_constraint,
    landing,
    observation,
    separation,
    spacing_constraint,
    spacing_learner,
)
from .schmidt import considered_states, considered_update, known_states, stance_gain

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
    epoch,
    turn,
    separation,
    observation,
    spacing_constraint,
    distance_constraint,
    spacing_learner,
    landing,
)
ENTRIES = (
    "advance",
    "step",
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
    "learn_spacing",
    "landing",
)


@dataclass(frozen=True)
class Engine:
    """The kernel's entry points in one of the two forms."""

    name: str
    advance: Callable[..., Any]
    step: Callable[..., Any]
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
    learn_spacing: Callable[..., Any]
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
    return Engine("interpreted", **{name: functions[name] for name in ENTRIES})
