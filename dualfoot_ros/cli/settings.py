"""Parameters given on the command line as ``KEY=VALUE``."""

from __future__ import annotations

from typing import Any

from ..core.errors import ConfigError


def setting(text: str) -> tuple[str, Any]:
    """Return name and value of ``KEY=VALUE``, the value as YAML reads it.

    Raises
    ------
    ConfigError
        When it is not of that form.
    """
    import yaml

    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise ConfigError(f"--set {text!r} is not understood; allowed is KEY=VALUE")
    try:
        loaded = yaml.safe_load(value)
        return key, float(loaded) if isinstance(loaded, str) else loaded  # YAML 1.1: 1e-3 is text
    except (ValueError, yaml.YAMLError):
        return key, value
