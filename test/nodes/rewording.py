"""Import modules with all their sentences reworded, by a hook on the import system.

A sentence is any text with a space in it that is no docstring, the constant parts of f-strings
included.  Its letters are exchanged; what stands in braces, for ``str.format``, stays.
"""

import ast
import codecs
import re
import sys
from importlib.machinery import PathFinder, SourceFileLoader

FIELDS = re.compile(r"(\{[^{}]*\})")


def reword(sentence: str) -> str:
    """Return a sentence of which no word is the same."""
    parts = FIELDS.split(sentence)
    return "".join(p if FIELDS.fullmatch(p) else codecs.encode(p, "rot13") for p in parts)


class Reworder(ast.NodeTransformer):
    """Rewords the sentences of a syntax tree."""

    def visit_Expr(self, node: ast.Expr) -> ast.Expr:
        if isinstance(node.value, ast.Constant):
            return node  # a docstring
        self.generic_visit(node)
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        if not isinstance(node.value, str) or " " not in node.value:
            return node
        return ast.copy_location(ast.Constant(reword(node.value)), node)


class RewordingLoader(SourceFileLoader):
    """Loads a module from its reworded source, past the cache of compiled files."""

    def get_code(self, fullname):
        path = self.get_filename(fullname)
        tree = Reworder().visit(ast.parse(self.get_data(path)))
        return compile(ast.fix_missing_locations(tree), path, "exec")


class RewordingFinder:
    """Finds the modules whose names begin with one of ``prefixes``."""

    def __init__(self, *prefixes: str) -> None:
        self._prefixes = prefixes

    def find_spec(self, name, path=None, target=None):
        if not name.startswith(self._prefixes):
            return None
        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and isinstance(spec.loader, SourceFileLoader):
            spec.loader = RewordingLoader(spec.loader.name, spec.loader.path)
        return spec


def install(*prefixes: str) -> None:
    """Reword the modules whose names begin with one of ``prefixes``, from now on."""
    sys.meta_path.insert(0, RewordingFinder(*prefixes))
