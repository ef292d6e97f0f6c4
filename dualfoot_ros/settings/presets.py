"""Configurations by name: the presets of the package, or a parameter file of the user's own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from ..core import ConfigError, TrackerConfig, nested
from .files import flat, read_parameters
from .nodes import node_parameter_names

PACKAGE = "dualfoot_ros"
PAPER_NOISE = "paper_noise"


def load_config(
    name_or_path: str | Path | None = None,
    overrides: Mapping[str, Any] | None = None,
    *,
    paper_noise: bool = False,
) -> TrackerConfig:
    """Return the configuration of a preset or a parameter file, changed by ``overrides``.

    Parameters of the nodes (topics, frames ...) may stand in the same file; they are passed over.

    Parameters
    ----------
    name_or_path : name of a preset ("liu2023"), path of a YAML file, or None for the defaults
    overrides : tracker parameters, dotted or nested, that win over the file
    paper_noise : take noise, bias and c0 of the paper of a preset too, in place of the defaults

    Raises
    ------
    ConfigError
        For a preset or file that does not exist, a file that is no parameter file, for the noise
        of a paper where there is none, and for any parameter that is unknown or out of its range.
    """
    values = {} if name_or_path is None else _tracker_values(find_config(name_or_path))
    if paper_noise:
        values.update(_tracker_values(paper_noise_file(name_or_path)))
    values.update(flat(nested(overrides or {})))
    return TrackerConfig.from_mapping(values)


def preset_names() -> list[str]:
    """Return the names of the presets of the package, sorted."""
    return sorted({path.stem for folder in _folders() for path in folder.glob("*.yaml")})


def find_config(name_or_path: str | Path) -> Path:
    """Return the file of a preset, or the file itself.

    Raises
    ------
    ConfigError
        Naming the presets there are.
    """
    path = Path(name_or_path).expanduser()
    if path.is_file():
        return path
    if path.suffix or len(path.parts) != 1:
        raise ConfigError(f"configuration file '{path}' does not exist")
    for folder in _folders():
        candidate = folder / f"{path}.yaml"
        if candidate.is_file():
            return candidate
    raise ConfigError(f"unknown preset '{path}'; known: {', '.join(preset_names())}")


def paper_noise_names() -> list[str]:
    """Return the names of the presets whose paper states noise, bias or c0, sorted."""
    return sorted({path.stem for folder in _folders() for path in _noise_files(folder)})


def paper_noise_file(name: str | Path | None) -> Path:
    """Return the file with noise, bias and c0 of the paper of a preset.

    Raises
    ------
    ConfigError
        Naming the presets that have one.
    """
    for folder in _folders():
        for path in _noise_files(folder):
            if name is not None and path.stem == str(name):
                return path
    given = "no preset" if name is None else f"'{name}'"
    raise ConfigError(
        f"noise of a paper is asked for with {given}; there is some for the presets "
        f"{', '.join(paper_noise_names())}"
    )


def _noise_files(folder: Path) -> list[Path]:
    return sorted((folder / PAPER_NOISE).glob("*.yaml"))


def _tracker_values(path: Path) -> dict[str, Any]:
    others = node_parameter_names()
    values = {name: v for name, v in read_parameters(path).items() if name not in others}
    try:
        TrackerConfig.from_mapping(values)
    except ConfigError as error:
        raise ConfigError(f"{path}: {error}") from None
    return values


def _folders() -> Iterator[Path]:
    """Yield where presets may be: the ament share, the installed package, the source tree."""
    try:
        from ament_index_python.packages import get_package_share_directory

        yield Path(get_package_share_directory(PACKAGE)) / "config"
    except (ImportError, LookupError, OSError):
        pass
    with resources.as_file(resources.files(PACKAGE)) as package:
        yield package / "config"
        yield package.parent / "config"
