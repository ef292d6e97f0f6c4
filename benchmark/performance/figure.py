"""One line of the table: a ratio, what it is a ratio to, and what is wanted."""

from __future__ import annotations

from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Figure:
    """One measured figure.

    Attributes
    ----------
    name : what was measured
    ratio : to the unit, from the same interleaved run; nan where it is none
    unit : "C" (CPU of an epoch in C), "numpy" (CPU of ``import numpy``), "pass-through" ...
    measured : the figure itself, with its unit
    wanted : largest ratio that is wanted, or None
    """

    name: str
    ratio: float
    unit: str
    measured: str
    wanted: float | str | None = None

    def to_dict(self) -> dict[str, float | str | None]:
        """Return the fields by name."""
        return asdict(self)
