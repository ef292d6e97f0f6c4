import pytest
from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter

from dualfoot_ros.core.config import TrackerConfig, all_specs
from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.core.groups import ZuptConfig
from dualfoot_ros.nodes.ros.declared_parameters import COLUMNS, _format, declare, descriptor, group

SPECS = {spec.name: spec for spec in all_specs()}


def declared(bench, values=None):
    node = bench.add(bench_node, values)
    return node, declare(node, SPECS.values())


def bench_node(**options):
    from rclpy.node import Node

    return Node("probe", **options)


def test_every_parameter_of_the_tracker_is_declared_with_its_default(bench):
    node, values = declared(bench)
    assert TrackerConfig.from_mapping(values).to_mapping() == TrackerConfig().to_mapping()
    assert node.get_parameter("zupt.std").value == ZuptConfig().std


def test_a_descriptor_tells_range_and_meaning():
    found = descriptor(SPECS["zupt.std"])
    spec = SPECS["zupt.std"]
    assert found.read_only and found.description == spec.description
    assert found.floating_point_range[0].from_value == spec.minimum
    assert found.floating_point_range[0].to_value == spec.maximum
    assert "one of zupt" in descriptor(SPECS["method"]).additional_constraints
    assert descriptor(SPECS["heading.from_stance"]).integer_range[0].step == 1


def test_a_whole_number_becomes_a_real_one(bench):
    node, values = declared(bench, {"zupt.std": 1})
    assert values["zupt.std"] == 1.0 and isinstance(values["zupt.std"], float)
    assert node.describe_parameter("zupt.std").type == ParameterType.PARAMETER_DOUBLE


def test_a_parameter_cannot_be_changed_while_the_node_runs(bench):
    node, _ = declared(bench)
    (result,) = node.set_parameters([Parameter("zupt.std", value=0.2)])
    assert not result.successful and "read-only" in result.reason


@pytest.mark.parametrize("value", ["much", -1.0, True, 1e9, float("nan")])
def test_a_value_of_the_wrong_type_or_range_is_refused_by_name(bench, value):
    with pytest.raises(ConfigError, match=r"'zupt\.std' is .*; allowed is a number in"):
        declared(bench, {"zupt.std": value})


def test_a_group_is_the_part_of_the_values_that_it_declares(bench):
    _, values = declared(bench, {"zupt.std": 0.5})
    assert group(ZuptConfig, values, "zupt.") == ZuptConfig(std=0.5)


def test_the_configuration_is_logged_in_lines_that_a_terminal_holds():
    values = TrackerConfig().to_mapping()
    lines = _format(values).splitlines()
    assert len(lines) > 10 and all(len(line) <= COLUMNS for line in lines)
    text = " ".join(" ".join(lines).split())
    assert f"method={values['method']}" in text
    assert f"zupt.std={values['zupt.std']}" in text
    assert "idc." not in text
