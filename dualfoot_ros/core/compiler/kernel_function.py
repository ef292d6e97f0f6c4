"""What is known of a function of the kernel: its source, and what its names stand for.

A name is an integer unless something real is assigned to it or handed over for it.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
import types
from collections.abc import Mapping, Sequence
from typing import Any

from .entries import Kind

INTEGER, REAL = Kind.INTEGER, Kind.REAL


class TranslationError(TypeError):
    """What the kernel uses and the translation to C does not know."""


class KernelFunction:
    """What is known of a function so far: the kinds of its names and of what it returns."""

    def __init__(self, function: types.FunctionType) -> None:
        """Read the source; nothing is known of its names yet."""
        (tree,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
        assert isinstance(tree, ast.FunctionDef)
        self.name, self.body = function.__name__, tree.body
        self.globals: Mapping[str, Any] = function.__globals__
        self.parameters = [each.arg for each in tree.args.args]
        self.defaults = tree.args.defaults
        self.kinds = dict.fromkeys(self.parameters, INTEGER)
        self.result: list[Kind] = []

    @property
    def returned(self) -> str:
        """The type in C of what it returns."""
        if len(self.result) < 2:
            return self.result[0] if self.result else "void"
        return f"struct {self.name}_result"

    @property
    def head(self) -> str:
        """The head of the function in C."""
        given = ", ".join(f"{self.kinds[name]} {name}" for name in self.parameters)
        return f"static {self.returned} {self.name}({given})"

    def know(self, name: str, kind: Kind) -> None:
        """Take note that ``name`` stands for ``kind``, among other things."""
        known = self.kinds.get(name, INTEGER)
        if kind.is_array and known is INTEGER:
            known = kind
        self.kinds[name] = REAL if REAL in (known, kind) and not known.is_array else known

    def returns(self, kinds: Sequence[Kind]) -> None:
        """Take note of the kinds of what it returns."""
        known = self.result or [INTEGER] * len(kinds)
        self.result = [
            REAL if REAL in pair else INTEGER for pair in zip(known, kinds, strict=True)
        ]
