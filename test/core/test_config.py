"""Parameters are data: each has a meaning, a unit and a range, and is refused by name."""

from __future__ import annotations

import math
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.core import ConfigError, DualFootTracker, TrackerConfig
from dualfoot_ros.core.config import all_specs
from dualfoot_ros.core.constraints import METHODS
from dualfoot_ros.core.parameters import ParameterSpec

SPECS = {spec.name: spec for spec in all_specs()}
NUMBERS = [s for s in SPECS.values() if type(s.default) in (float, int)]
PURE = {
    "from_stance", "to_stance", "threshold", "barometer_samples", "magnetic_size",
    "magnetic_stances", "kappa", "iterations", "share", "every", "alpha", "beta", "scaling",
    "straight_strides", "landing_gate",
}  # fmt: skip


@pytest.mark.parametrize("spec", SPECS.values(), ids=SPECS)
def test_every_parameter_says_what_it_means_and_its_default_is_allowed(spec):
    assert len(spec.description) > 5
    assert not spec.description.endswith(".")
    assert TrackerConfig.from_mapping({spec.name: spec.default}).to_mapping()[spec.name] == (
        spec.default
    )


@pytest.mark.parametrize("spec", NUMBERS, ids=lambda s: s.name)
def test_every_number_has_a_range(spec):
    assert spec.minimum is not None
    assert spec.maximum is not None
    assert spec.minimum <= spec.default <= spec.maximum


@pytest.mark.parametrize("spec", NUMBERS, ids=lambda s: s.name)
def test_every_number_with_a_dimension_has_a_unit(spec):
    assert bool(spec.unit) != (spec.name.split(".")[-1] in PURE)


@pytest.mark.parametrize("spec", [s for s in SPECS.values() if s.choices], ids=lambda s: s.name)
def test_a_text_outside_its_choices_is_refused_with_the_choices(spec):
    with pytest.raises(ConfigError) as caught:
        TrackerConfig.from_mapping({spec.name: "nonsense"})
    assert spec.name in str(caught.value)
    assert "'nonsense'" in str(caught.value)
    assert all(choice in str(caught.value) for choice in spec.choices)


def outside(spec: ParameterSpec) -> list[float]:
    numbers: list[float] = [math.nan, math.inf, -math.inf]
    return [*numbers, spec.minimum - 1, spec.maximum * 2 + 1]


@pytest.mark.parametrize("spec", NUMBERS, ids=lambda s: s.name)
def test_a_number_out_of_its_range_is_refused_with_name_value_and_range(spec):
    for number in outside(spec):
        with pytest.raises(ConfigError) as caught:
            TrackerConfig.from_mapping({spec.name: number})
        message = str(caught.value)
        assert f"'{spec.name}'" in message
        assert f"{spec.minimum:g}" in message
        assert spec.unit in message


@pytest.mark.parametrize("value", ("0.5", None, [1.0], {"a": 1}, True))
@pytest.mark.parametrize("name", ("zupt.std", "gravity", "idc.distance"))
def test_a_value_of_the_wrong_type_is_refused_by_name(name, value):
    with pytest.raises(ConfigError, match=f"'{name}"):
        TrackerConfig.from_mapping({name: value})


@pytest.mark.parametrize(
    ("mapping", "what"),
    [
        ({"zupt.stdd": 1.0}, "unknown parameter 'zupt.stdd'; known: .*std"),
        ({"zuptt": {"std": 1.0}}, "unknown parameter 'zuptt'; known: .*zupt"),
        ({"idc": {"distanse": 0.2}}, "unknown parameter 'idc.distanse'; known: .*distance"),
        ({"zupt": 3.0}, "'zupt' is 3.0; allowed is a group"),
        ({"method": "kalman"}, "'method' is 'kalman'; allowed is one of .*idc"),
        ({"method": 3}, "'method' is 3"),
        ({"zupt": 1.0, "zupt.std": 0.1}, "zupt"),
        ({"heading": {"from_stance": 3, "to_stance": 3}}, "heading.to_stance"),
    ],
)
def test_a_mistake_is_refused_with_what_would_have_been_right(mapping, what):
    with pytest.raises(ConfigError, match=what):
        TrackerConfig.from_mapping(mapping)


def test_dotted_and_nested_names_are_the_same():
    dotted = TrackerConfig.from_mapping({"idc.distance": 0.2, "idc.kappa": 0.6, "zupt.std": 0.01})
    nested = TrackerConfig.from_mapping(
        {"idc": {"distance": 0.2, "kappa": 0.6}, "zupt": {"std": 0.01}}
    )
    mixed = TrackerConfig.from_mapping(
        {"idc.distance": 0.2, "idc": {"kappa": 0.6}, "zupt.std": 0.01}
    )
    assert dotted.to_mapping() == nested.to_mapping() == mixed.to_mapping()


def drawn(spec: ParameterSpec):
    if spec.choices:
        return st.sampled_from(spec.choices)
    if isinstance(spec.default, bool):
        return st.booleans()
    if isinstance(spec.default, int):
        return st.integers(int(spec.minimum), int(spec.maximum))
    if isinstance(spec.default, float):
        return st.floats(spec.minimum, spec.maximum)
    return st.just(spec.default)


FREE = {n: drawn(s) for n, s in SPECS.items() if not n.startswith("heading.")}


@given(st.fixed_dictionaries({}, optional=FREE))
@settings(max_examples=40, deadline=None)
def test_a_configuration_comes_back_from_its_mapping_unchanged(mapping):
    config = TrackerConfig.from_mapping(mapping)
    told = config.to_mapping()
    assert TrackerConfig.from_mapping(told).to_mapping() == told
    assert all(told[name] == value for name, value in mapping.items())
    assert set(told) == set(SPECS)


def test_every_method_is_a_class_whose_module_names_it_and_whose_config_is_documented():
    for name, method in METHODS.items():
        assert method.name == name
        assert f"``{name}``" in sys.modules[method.__module__].__doc__.splitlines()[0]
        assert method.__doc__
        assert method.config_class.__doc__


def test_an_unknown_engine_is_refused_with_the_known_ones():
    with pytest.raises(ConfigError, match="'fast'; allowed is one of auto, compiled, interpreted"):
        DualFootTracker(engine="fast")


def test_a_configuration_cannot_be_changed_by_accident():
    config = TrackerConfig()
    with pytest.raises(AttributeError):
        config.method = "zupt"
