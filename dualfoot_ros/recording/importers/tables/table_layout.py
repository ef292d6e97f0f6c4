"""The layout of a table: which column holds what, in which units; given, recognised, or known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from ....core import Increments

AXES = "xyz"
ROLES = (
    *("time", "counter", "device", "stream"),
    *(f"{quantity}{axis}" for quantity in ("a", "g", "m") for axis in AXES),
    *(f"dq{axis}" for axis in "wxyz"),
    *(f"dv{axis}" for axis in AXES),
)
"""Names of what a column may hold, as ``--columns`` has them."""

VECTORS = {
    "force": ("ax", "ay", "az"),
    "rate": ("gx", "gy", "gz"),
    "field": ("mx", "my", "mz"),
    "turn": ("dqw", "dqx", "dqy", "dqz"),
    "push": ("dvx", "dvy", "dvz"),
}
"""The columns of a vector: ``turn`` and ``push`` are dq and dv, increments over a sample."""


@dataclass(frozen=True)
class Part:
    """One file of a folder: which vector it holds, and how its name reads."""

    holds: str
    pattern: str


@dataclass(frozen=True)
class Layout:
    """How to read a table; what is empty is found from the table itself.

    Attributes
    ----------
    name, about : its name, and the device or program that writes it
    marks : what only it has, all of them: plain names of columns ("*" for any words before, "|"
        between alternatives), or after "~" a pattern that a line before the names has
    parts : files of a folder of one sensor; one part "all" where a single file has everything
    columns : name of the column of a role, or its number from 1
    prefer : words in names of columns that win where two sensors of a kind are there
    delimiter, decimal : of the text
    skip : lines before the table that are no part of it
    time_units : units of the time; the first that gives a possible rate is taken
    rate_hz : sampling rate, where no column tells the time
    force_unit, rate_unit, field_unit : units where neither names nor header tell
    wrap_bits : bits of a device counter that wraps, 0 for a time that does not
    counts_samples : whether the counter counts samples (and not packets of all kinds)
    increments : what the samples are, None where the maker does not say
    remark : what a user has to know, told where something is missing
    """

    name: str = "csv"
    about: str = ""
    marks: tuple[str, ...] = ()
    parts: tuple[Part, ...] = ()
    columns: Mapping[str, str] = field(default_factory=dict)
    prefer: tuple[str, ...] = ()
    delimiter: str | None = None
    decimal: str | None = None
    skip: int = 0
    time_units: tuple[str, ...] = ()
    rate_hz: float | None = None
    force_unit: str | None = None
    rate_unit: str | None = None
    field_unit: str | None = None
    wrap_bits: int = 0
    counts_samples: bool = True
    increments: Increments | None = None
    remark: str = ""

    def told(self) -> dict[str, Any]:
        """Return the fields that say something, by name."""
        default = Layout()
        return {
            item.name: getattr(self, item.name)
            for item in fields(self)
            if getattr(self, item.name) != getattr(default, item.name)
        }

    def over(self, base: Layout) -> Layout:
        """Return ``base`` with everything that this one says in place of what that says."""
        said = self.told()
        said["columns"] = {**base.columns, **self.columns}
        return Layout(
            **{item.name: said.get(item.name, getattr(base, item.name)) for item in fields(base)}
        )
