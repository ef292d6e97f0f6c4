import importlib.util
from pathlib import Path

import pytest

from dualfoot_ros.core.config import TrackerConfig, all_specs
from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.settings.files import read_parameters, yaml_value
from dualfoot_ros.settings.nodes import node_parameter_names
from dualfoot_ros.settings.presets import find_config, load_config, preset_names

ROOT = Path(__file__).resolve().parents[2]
PRESETS = sorted(path.stem for path in (ROOT / "config").glob("*.yaml"))


def generated() -> dict[Path, str]:
    path = ROOT / "scripts" / "write_config.py"
    spec = importlib.util.spec_from_file_location("write_config", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.files()


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.yaml"
    path.write_text(text)
    return path


def test_generated_files_are_what_the_declarations_say():
    for path, text in generated().items():
        assert path.read_text() == text, f"{path.name} is out of date: run `make config`"


def test_default_yaml_gives_the_default_configuration():
    assert load_config("default").to_mapping() == TrackerConfig().to_mapping()


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_loads_and_is_listed(name):
    assert name in preset_names()
    assert set(load_config(name).to_mapping()) == {spec.name for spec in all_specs()}


def test_liu2023_has_the_numbers_of_the_paper():
    config = load_config("liu2023", paper_noise=True)
    idc = config.constraint
    assert (config.method, config.zupt.std, config.zupt.lever_arm) == ("idc", 0.03, 0.0)
    assert (config.stance.threshold, config.stance.window * 200.0) == (6000.0, 5.0)
    assert (idc.distance, idc.distance_std, idc.kappa) == (0.3, 0.0, 0.6)
    assert (idc.solver, idc.iterations, idc.apply_at) == ("iterative", 5, "detection")
    degree = 3.141592653589793 / 180.0
    assert config.noise.gyro == pytest.approx(0.24 * degree / 60.0, rel=1e-3)
    assert config.noise.accelerometer == pytest.approx(0.06 / 60.0, rel=1e-3)
    assert config.initial.gyro_bias == pytest.approx(10.0 * degree / 3600.0, rel=1e-3)
    assert config.initial.accelerometer_bias == pytest.approx(0.2e-3 * 9.80665, rel=1e-3)
    instability_to_drive = (2.0 / 1800.0) ** 0.5
    assert config.noise.gyro_bias == pytest.approx(
        config.initial.gyro_bias * instability_to_drive, rel=1e-3
    )
    assert config.noise.accelerometer_bias == pytest.approx(
        config.initial.accelerometer_bias * instability_to_drive, rel=1e-3
    )


def test_overrides_win_over_the_file_dotted_or_nested():
    assert load_config("liu2023", {"zupt.std": 0.05}, paper_noise=True).zupt.std == 0.05
    assert load_config("liu2023", {"zupt": {"std": 0.05}}).zupt.std == 0.05
    assert load_config("liu2023", {"zupt": {"std": 0.05}}).zupt.lever_arm == 0.0


def test_unknown_preset_names_those_that_exist():
    with pytest.raises(ConfigError, match=r"unknown preset 'liu'; known: .*default.*liu2023"):
        load_config("liu")


def test_missing_file_is_named():
    with pytest.raises(ConfigError, match=r"configuration file 'no/such\.yaml' does not exist"):
        load_config("no/such.yaml")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "not valid YAML"),
        ("", "has no parameters"),
        ("method: idc", "has no parameters"),
        ("/**:\n  ros__parameters:\n    zupt:\n      sdt: 0.1\n", "unknown parameter 'zupt.sdt'"),
        ("/**:\n  ros__parameters:\n    zupt:\n      std: -1\n", r"'zupt.std' is -1.*allowed"),
        ("/**:\n  ros__parameters:\n    zupt: 3\n", "'zupt' is 3"),
    ],
)
def test_bad_file_is_refused_with_its_name_and_what_is_wrong(tmp_path, text, said):
    path = written(tmp_path, text)
    with pytest.raises(ConfigError, match=said) as caught:
        load_config(path)
    assert str(path) in str(caught.value)


def test_parameters_of_the_nodes_may_stand_in_the_same_file(tmp_path):
    text = "/**:\n  ros__parameters:\n    method: zupt\n    frames:\n      odom: map\n"
    assert load_config(written(tmp_path, text)).method == "zupt"


def test_sections_of_single_nodes_are_read_too(tmp_path):
    text = "/**/fusion:\n  ros__parameters:\n    zupt.std: 1e-2\n"
    assert load_config(written(tmp_path, text)).zupt.std == 0.01


def test_node_and_tracker_parameters_never_share_a_name():
    assert not node_parameter_names() & {spec.name for spec in all_specs()}


def test_a_float_is_written_so_that_ros_reads_a_float():
    assert [yaml_value(v) for v in (2.0, 1e-5, True, "", "g")] == [
        "2.0", "1.0e-05", "true", '""', "g",
    ]  # fmt: skip


def test_presets_are_found_in_the_source_tree():
    assert find_config("liu2023").read_text() == (ROOT / "config" / "liu2023.yaml").read_text()


def test_what_is_written_is_what_is_read():
    read = read_parameters(ROOT / "config" / "default.yaml")
    found = {name: tuple(v) if isinstance(v, list) else v for name, v in read.items()}
    assert found == {spec.name: spec.default for spec in all_specs()}
