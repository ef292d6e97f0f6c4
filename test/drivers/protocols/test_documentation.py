"""What docs/reference/sensors.md says is what the package does."""

import re
from pathlib import Path

import pytest

from dualfoot_ros.drivers import (
    COUNTERS,
    FORMATS,
    SCHEMES,
    BackoffConfig,
    CheckConfig,
    ConditioningConfig,
    SourceError,
    parse_uri,
)

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "sensors.md"
TEXT = PAGE.read_text(encoding="utf-8")
ROWS = [line for line in TEXT.splitlines() if line.startswith("| `")]


@pytest.mark.parametrize(
    "group",
    [
        *(scheme.options for scheme in SCHEMES.values()),
        *(known.options for known in FORMATS.values()),
        BackoffConfig,
        ConditioningConfig,
        CheckConfig,
    ],
)
def test_every_option_is_documented_with_its_default(group):
    for spec in group.specs():
        rows = [row for row in ROWS if f"`{spec.name}`" in row.split("|")[1]]
        default = str(spec.default).lower() if isinstance(spec.default, bool) else spec.default
        assert any(f"`{default}`" in row or default == "" for row in rows), spec.name


def test_every_format_and_counter_is_documented():
    for name in (*FORMATS, *COUNTERS):
        assert any(f"`{name}`" in row.split("|")[1] for row in ROWS), name


def test_every_source_that_is_shown_is_understood():
    block = TEXT.split("```")[1]
    sources = [line.split()[0] for line in block.strip().splitlines()]
    assert {source.partition(":")[0] for source in sources} == set(SCHEMES)
    for source in sources:
        parse_uri(source)


def test_the_python_example_names_what_exists():
    from dualfoot_ros import drivers

    (names,) = re.findall(r"from dualfoot_ros.drivers import (.*)", TEXT)
    assert all(hasattr(drivers, name.strip()) for name in names.split(","))


def test_the_short_names_stand_for_the_same_classes():
    from dualfoot_ros import drivers

    short = re.findall(r"`(\w+)` \(`(\w+)` for short\)", TEXT)
    assert len(short) == 2
    assert all(getattr(drivers, name) is getattr(drivers, other) for name, other in short)


def test_what_the_document_says_is_refused_is_refused():
    with pytest.raises(SourceError):
        parse_uri("udp://:8000?format=ximu3&no_such=1")
