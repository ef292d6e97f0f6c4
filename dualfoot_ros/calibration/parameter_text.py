"""Measured parameters as a parameter file for ``--config`` and the nodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..core import all_specs, check
from ..settings import parameter_file


def parameter_text(values: Mapping[str, float], remarks: Sequence[str]) -> str:
    """Return a parameter file with these tracker parameters, ``remarks`` first as comments.

    Raises
    ------
    ConfigError
        When a value is out of the range of its parameter.
    """
    specs = [
        spec._replace(default=check(spec, values[spec.name]))
        for spec in all_specs()
        if spec.name in values
    ]
    comments = "".join(f"# {line}\n" for line in remarks)
    return f"{comments}\n{parameter_file('/**', specs)}"
