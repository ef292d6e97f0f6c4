"""Faces of rooms whose modules are imported when a name of theirs is first asked for.

A node needs some names of `drivers` and `calibration`, whose modules took a quarter of the time in
which it starts.
"""

from __future__ import annotations

import ast
import inspect
import sys
from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import Any


def lazy_face(package: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Return ``__getattr__`` and ``__dir__`` of a package that imports ``if TYPE_CHECKING:`` only.

    So what mypy reads is also what is imported, one module at a time.  No name may be that of a
    module of the package: once that is imported, it has the name.
    """

    def find(name: str) -> Any:
        if name.startswith("__") or name not in _homes(package):
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, its_name = _homes(package)[name]
        value = getattr(import_module(module, package), its_name)
        setattr(sys.modules[package], name, value)
        return value

    def names() -> list[str]:
        return sorted({*vars(sys.modules[package]), *_homes(package)})

    return find, names


@cache
def _homes(package: str) -> dict[str, tuple[str, str]]:
    """Return the module that each name of a face is imported from, and its name there."""
    tree = ast.parse(inspect.getsource(sys.modules[package]))
    blocks = [node.body for node in tree.body if isinstance(node, ast.If)]
    return {
        alias.asname or alias.name: ("." * node.level + (node.module or ""), alias.name)
        for body in blocks
        for node in body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
