"""Parameters of the nodes, presets and parameter files."""

from .files import flat, parameter_file, read_parameters
from .nodes import (
    AdapterOptions,
    BringupOptions,
    Covariance,
    Frames,
    FusionOptions,
    Input,
    Path,
    Play,
    ReplayOptions,
    Reports,
    Units,
    node_parameter_names,
    node_specs,
)
from .presets import find_config, load_config, preset_names

__all__ = [
    "AdapterOptions",
    "BringupOptions",
    "Covariance",
    "Frames",
    "FusionOptions",
    "Input",
    "Path",
    "Play",
    "ReplayOptions",
    "Reports",
    "Units",
    "find_config",
    "flat",
    "load_config",
    "node_parameter_names",
    "node_specs",
    "parameter_file",
    "preset_names",
    "read_parameters",
]
