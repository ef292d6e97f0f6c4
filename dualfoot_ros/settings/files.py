"""Parameter files as ROS 2 reads them: ``/**: ros__parameters:`` with groups below it."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core import ConfigError, ParameterSpec, nested

if TYPE_CHECKING:
    from yaml import SafeLoader

WIDTH = 98
EXPONENT_ONLY = re.compile(r"^[-+]?[0-9]+[eE][-+]?[0-9]+$")


def read_parameters(path: Path) -> dict[str, Any]:
    """Return the parameters of ``path`` by dotted name, the sections of all nodes merged.

    Raises
    ------
    ConfigError
        When the file cannot be read as YAML or holds no ``ros__parameters``.
    """
    import yaml

    try:
        document = yaml.load(path.read_text(encoding="utf-8"), Loader=_loader())  # noqa: S506  (a SafeLoader)
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        reason = " ".join(str(error).split())
        raise ConfigError(f"configuration file '{path}' is not valid YAML: {reason}") from None
    found: dict[str, Any] = {}
    sections = list(_sections(document))
    for section in sections:
        found.update(flat(nested(section)))
    if not sections:
        raise ConfigError(
            f"configuration file '{path}' has no parameters; expected is '/**:' with "
            "'ros__parameters:' below it, as in config/default.yaml"
        )
    return found


def flat(tree: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return a nested mapping with dotted keys."""
    found: dict[str, Any] = {}
    for key, value in tree.items():
        if isinstance(value, Mapping):
            found.update(flat(value, f"{prefix}{key}."))
        else:
            found[f"{prefix}{key}"] = value
    return found


def parameter_file(section: str, specs: Iterable[ParameterSpec]) -> str:
    """Return a section of a parameter file: every parameter with unit, range and meaning."""
    lines = [f"{section}:", "  ros__parameters:"]
    group = ""
    for spec in specs:
        head, _, key = spec.name.rpartition(".")
        if head != group:
            lines += ["", f"    {head}:"]
            group = head
        indent = "      " if head else "    "
        lines += [*_comment(spec, indent), f"{indent}{key}: {yaml_value(spec.default)}"]
    return "\n".join(lines) + "\n"


def yaml_value(value: Any) -> str:
    """Return a value as YAML; a float always with its decimal point, as ROS needs it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return "[" + ", ".join(yaml_value(v) for v in value) + "]"
    if isinstance(value, float):
        mantissa, mark, exponent = repr(value).partition("e")
        return f"{mantissa}.0{mark}{exponent}" if mark and "." not in mantissa else repr(value)
    if isinstance(value, str) and not re.fullmatch(r"[A-Za-z_][\w/]*", value):
        return f'"{value}"'
    return str(value)


def _comment(spec: ParameterSpec, indent: str) -> Iterator[str]:
    start = f"{indent}# "
    text = f"{spec.description}; {spec.allowed}"
    yield from textwrap.wrap(text, WIDTH, initial_indent=start, subsequent_indent=start)


def _sections(document: Any) -> Iterator[Mapping[str, Any]]:
    """Yield what stands below each ``ros__parameters``, at any depth of node names."""
    if not isinstance(document, Mapping):
        return
    for key, value in document.items():
        if key == "ros__parameters" and isinstance(value, Mapping):
            yield value
        else:
            yield from _sections(value)


def _loader() -> type[SafeLoader]:
    """Return a loader that reads 1e-3 as a number, as the parser of ROS does."""
    import yaml

    class Loader(yaml.SafeLoader):
        """SafeLoader with YAML 1.2's idea of a number."""

    Loader.add_implicit_resolver("tag:yaml.org,2002:float", EXPONENT_ONLY, list("-+0123456789"))
    return Loader
