"""Parameters of the nodes, presets and parameter files."""

from .files import flat, parameter_file, read_parameters
from .live import LIVE, reason_read_only
from .nodes import (
    AdapterConfig,
    BringupConfig,
    CovarianceConfig,
    FrameConfig,
    FusionConfig,
    InputConfig,
    KindConfig,
    PathConfig,
    PersonConfig,
    PlayConfig,
    ReplayConfig,
    ReportConfig,
    UnitConfig,
    node_parameter_names,
    node_specs,
)
from .page_config import LOOPBACK, PAGE_PORT, PageConfig
from .presets import (
    find_config,
    load_config,
    paper_noise_file,
    paper_noise_names,
    preset_names,
)

__all__ = [
    "LIVE",
    "LOOPBACK",
    "PAGE_PORT",
    "AdapterConfig",
    "BringupConfig",
    "CovarianceConfig",
    "FrameConfig",
    "FusionConfig",
    "InputConfig",
    "KindConfig",
    "PageConfig",
    "PathConfig",
    "PersonConfig",
    "PlayConfig",
    "ReplayConfig",
    "ReportConfig",
    "UnitConfig",
    "find_config",
    "flat",
    "load_config",
    "node_parameter_names",
    "node_specs",
    "paper_noise_file",
    "paper_noise_names",
    "parameter_file",
    "preset_names",
    "read_parameters",
    "reason_read_only",
]
