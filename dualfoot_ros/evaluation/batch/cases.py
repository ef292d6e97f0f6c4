"""The cases of a comparison: methods and presets by name, and sweeps of a parameter."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core import METHODS, EvaluationError, TrackerConfig, all_specs
from ...settings import load_config, paper_noise_names, preset_names

SHORT = {"gamma": "stance.threshold"}
MOST_VALUES = 200


@dataclass(frozen=True)
class Case:
    """One configuration under a name; ``swept`` is (parameter, value) where one was swept."""

    label: str
    config: TrackerConfig
    swept: tuple[str, float] | None = None


@dataclass(frozen=True)
class Sweep:
    """A parameter, by a short name or its dotted one, and the values it takes."""

    name: str
    values: tuple[float, ...]

    @classmethod
    def parse(cls, text: str) -> Sweep:
        """Read ``NAME=START:STOP:STEP`` (both ends included) or ``NAME=A,B,C``.

        Raises
        ------
        EvaluationError
            When it is neither.
        """
        name, _, values = text.partition("=")
        try:
            numbers = [float(v) for v in values.replace(":", ",").split(",")]
        except ValueError:
            numbers = []
        if not (name and numbers) or not np.isfinite(numbers).all():
            raise EvaluationError(_sweep_help(text))
        if ":" in values:
            numbers = _stepped(text, numbers)
        return cls(name, tuple(numbers))

    def parameter(self, method: str) -> str | None:
        """Return the dotted name of the swept parameter of ``method``, None if it has none."""
        name = SHORT.get(self.name, self.name)
        dotted = name if "." in name else f"{method}.{name}"
        group = dotted.partition(".")[0]
        if group in METHODS and group != method:
            return None
        return dotted if any(spec.name == dotted for spec in all_specs()) else None


def _stepped(text: str, numbers: list[float]) -> list[float]:
    if len(numbers) != 3 or numbers[2] <= 0.0 or numbers[1] < numbers[0]:
        raise EvaluationError(_sweep_help(text))
    start, stop, step = numbers
    count = int((stop - start) / step + 1e-9) + 1
    if count > MOST_VALUES:
        raise EvaluationError(f"--sweep '{text}' has {count} values; allowed are {MOST_VALUES}")
    return [round(start + k * step, 12) for k in range(count)]


def _sweep_help(text: str) -> str:
    return (
        f"--sweep '{text}' is not understood; allowed is NAME=START:STOP:STEP or NAME=A,B,C, "
        "such as kappa=0.4:0.7:0.05 or gamma=3000,6000,9000"
    )


def case_names(text: str) -> list[str]:
    """Return the names in ``all`` or a list like ``zupt,idc,liu2023``.

    ``all`` is every method for a sensor on each foot (some have both on one shoe).

    Raises
    ------
    EvaluationError
        Naming what is neither a method nor a preset.
    """
    both_feet = [name for name, method in METHODS.items() if not method.sensors_on_one_shoe]
    names: list[str] = []
    for name in (part.strip() for part in text.split(",")):
        names += both_feet if name == "all" else [name]
    known = [*METHODS, *preset_names()]
    for name in names:
        if name not in known:
            raise EvaluationError(
                f"'{name}' is no method and no preset; allowed are all, {', '.join(known)}"
            )
    return list(dict.fromkeys(names))


def make_cases(
    names: Iterable[str],
    base: str | None = None,
    overrides: Mapping[str, Any] | None = None,
    sweeps: Sequence[Sweep] = (),
    *,
    paper_noise: bool = False,
) -> list[Case]:
    """Return the cases of methods (with the parameters of ``base``) and presets, sweeps after.

    ``paper_noise`` gives the presets noise, bias and c0 of their paper, where it states them.

    Raises
    ------
    EvaluationError
        When no method that was named has the parameter of a sweep.
    ConfigError
        When a value is out of its range.
    """
    plain = {name: _config(name, base, overrides or {}, paper_noise) for name in names}
    cases = [Case(name, config) for name, config in plain.items()]
    for sweep in sweeps:
        swept = [case for name, config in plain.items() for case in _swept(name, config, sweep)]
        if not swept:
            raise EvaluationError(
                f"no method among {', '.join(plain)} has the parameter '{sweep.name}' to sweep"
            )
        cases += swept
    return cases


def _config(
    name: str, base: str | None, overrides: Mapping[str, Any], paper_noise: bool
) -> TrackerConfig:
    stated = paper_noise_names() if paper_noise else []
    if name in METHODS:
        whole = {**overrides, "method": name}
        return load_config(base, whole, paper_noise=base in stated)
    return load_config(name, overrides, paper_noise=name in stated)


def _swept(name: str, config: TrackerConfig, sweep: Sweep) -> Iterator[Case]:
    dotted = sweep.parameter(config.method)
    if dotted is None:
        return
    values = config.to_mapping()
    whole = isinstance(values[dotted], int)
    for value in sweep.values:
        changed = {**values, dotted: int(value) if whole and value == int(value) else value}
        label = f"{name} {sweep.name}={value:g}"
        yield Case(label, TrackerConfig.from_mapping(changed), (sweep.name, value))
