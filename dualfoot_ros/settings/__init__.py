"""Parameters of the nodes, presets and parameter files."""

from .files import flat, parameter_file, read_parameters
from .nodes import (
    AdapterConfig,
    BringupConfig,
    CovarianceConfig,
    FrameConfig,
    FusionConfig,
    InputConfig,
    KindConfig,
    PathConfig,
    PlayConfig,
    ReplayConfig,
    ReportConfig,
    UnitConfig,
    node_parameter_names,
    node_specs,
)
from .presets import find_config, load_config, preset_names

__all__ = [
    "AdapterConfig",
    "BringupConfig",
    "CovarianceConfig",
    "FrameConfig",
    "FusionConfig",
    "InputConfig",
    "KindConfig",
    "PathConfig",
    "PlayConfig",
    "ReplayConfig",
    "ReportConfig",
    "UnitConfig",
    "find_config",
    "flat",
    "load_config",
    "node_parameter_names",
    "node_specs",
    "parameter_file",
    "preset_names",
    "read_parameters",
]
