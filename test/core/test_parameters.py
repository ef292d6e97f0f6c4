"""Declarations of parameters: the annotation is the type, for mypy, at import and for values."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import get_origin, get_type_hints

import pytest

from dualfoot_ros import calibration, drivers, nodes, settings, simulation  # noqa: F401
from dualfoot_ros.core import ConfigError, Parameters, parameter
from dualfoot_ros.core.parameters import is_declared


def groups(base: type[Parameters] = Parameters) -> Iterator[type[Parameters]]:
    """Yield every parameter class of the package."""
    for group in base.__subclasses__():
        yield group
        yield from groups(group)


GROUPS = [group for group in groups() if group.__module__.startswith("dualfoot_ros")]


def test_all_parameter_classes_are_looked_at():
    assert len(GROUPS) > 40


@pytest.mark.parametrize("group", GROUPS, ids=lambda g: g.__name__)
def test_every_default_is_of_the_type_that_its_annotation_says(group):
    hints = get_type_hints(group)
    specs = {spec.name: spec for spec in group.specs()}
    declared = [item.name for item in fields(group) if is_declared(item)]
    assert list(specs) == declared
    for name, spec in specs.items():
        kind = get_origin(hints[name]) or hints[name]
        assert spec.type is kind
        assert type(spec.default) is kind


@pytest.mark.parametrize(
    ("annotation", "default"),
    [
        ("float", "fast"),
        ("int", 0.5),
        ("int", True),
        ("bool", 1),
        ("str", 3),
        ("tuple[float, float, float]", (1.0, 2.0)),
        ("list[float]", [1.0]),
        ("float | None", None),
    ],
)
def test_a_default_of_another_type_is_refused_when_the_class_is_made(annotation, default):
    with pytest.raises(TypeError, match=r"Wrong\.rate is annotated .* default"):
        type(
            "Wrong",
            (Parameters,),
            {
                "__annotations__": {"rate": annotation},
                "rate": parameter(default, "a rate"),
                "__module__": __name__,
            },
        )


@dataclass(frozen=True)
class Whole(Parameters):
    """A number whose default happens to be whole."""

    share: float = parameter(0, "a share", minimum=0, maximum=1)


def test_a_value_is_converted_by_the_annotation_and_not_by_the_default():
    assert Whole().share == 0.0
    assert type(Whole().share) is float
    assert Whole(0.5).share == 0.5
    assert Whole.from_mapping({"share": 0.25}).share == 0.25
    (spec,) = Whole.specs()
    assert spec.allowed == "a number in [0, 1]"
    assert type(spec.default) is float
    with pytest.raises(ConfigError, match="'share' is 'fast'; allowed is a number"):
        Whole.from_mapping({"share": "fast"})


def test_mypy_refuses_a_default_of_another_type_than_the_annotation(tmp_path):
    pytest.importorskip("mypy")
    source = tmp_path / "declared.py"
    source.write_text(
        "from dataclasses import dataclass\n"
        "from dualfoot_ros.core.parameters import Parameters, parameter\n"
        "@dataclass(frozen=True)\n"
        "class Wrong(Parameters):\n"
        "    rate: float = parameter('fast', 'a rate')\n"
        "    size: int = parameter(0.5, 'a size')\n"
        "    good: float = parameter(0.5, 'a good one')\n"
    )
    # As `make types` runs it: with other options mypy would read the whole package anew, and leave
    # a cache behind with which `make types` does so too.
    command = [sys.executable, "-m", "mypy", str(source)]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    wrong = [line for line in done.stdout.splitlines() if "declared.py" in line]
    assert len(wrong) == 2, done.stdout + done.stderr
    assert 'expression has type "str", variable has type "float"' in wrong[0]
    assert 'expression has type "float", variable has type "int"' in wrong[1]
