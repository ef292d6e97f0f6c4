"""Expressions of the kernel in C: the same operations in the same order, and so the same bits."""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping
from functools import reduce
from typing import Any

from .entries import Kind
from .kernel_function import INTEGER, REAL, KernelFunction, TranslationError

Typed = tuple[str, Kind]  # an expression in C, and whether it is an integer or real

ARITHMETIC = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*"}
OF_INTEGERS = {ast.BitAnd: "&", ast.BitOr: "|", ast.LShift: "<<", ast.RShift: ">>"}
COMPARISONS = {
    ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=",
}  # fmt: skip
CHOICES = {"min": "less", "max": "greater"}
OF_THE_LIBRARY = {"sqrt", "sin", "cos", "copysign"}  # of math, with the same name in C


class ExpressionWriter:
    """Writes expressions of a function, and learns the kinds of names that calls hand over."""

    def __init__(self, function: KernelFunction, others: Mapping[str, KernelFunction]) -> None:
        """Write what is in ``function``, which may call ``others``."""
        self._function, self._others = function, others
        self.called: set[str] = set()

    def _written(self, node: ast.AST) -> Any:
        """Return what the method for this kind of node makes of it."""
        method = getattr(self, "_" + type(node).__name__.lower(), None)
        if method is None:
            raise self._unknown(node)
        return method(node)

    def _unknown(self, node: ast.AST) -> TranslationError:
        return TranslationError(
            f"{self._function.name} of the kernel has '{ast.unparse(node)}', which has no "
            "translation to C"
        )

    def _constant(self, node: ast.Constant) -> Typed:
        return self._number(node.value, node)

    def _number(self, value: object, node: ast.AST) -> Typed:
        if isinstance(value, int):  # or a truth value
            return str(int(value)), INTEGER
        if not isinstance(value, float):
            raise self._unknown(node)
        return "INFINITY" if value == math.inf else repr(value), REAL

    def _name(self, node: ast.Name) -> Typed:
        own = self._function
        if node.id in own.kinds:
            return node.id, own.kinds[node.id]
        return self._number(own.globals.get(node.id), node)

    def _attribute(self, node: ast.Attribute) -> Typed:
        if ast.unparse(node) != "math.inf":
            raise self._unknown(node)
        return self._number(math.inf, node)

    def _subscript(self, node: ast.Subscript) -> Typed:
        array, kind = self._written(node.value)
        if kind is Kind.ROWS and isinstance(node.slice, ast.Tuple):
            row, column = (self._written(each)[0] for each in node.slice.elts)
            return f"{array}.x[{array}.columns * ({row}) + {column}]", REAL
        return (
            f"{array}[{self._written(node.slice)[0]}]",
            INTEGER if kind in {Kind.INTEGERS, Kind.BYTES} else REAL,
        )

    def _binop(self, node: ast.BinOp) -> Typed:
        (left, a), (right, b) = self._written(node.left), self._written(node.right)
        kind, operation = REAL if REAL in (a, b) else INTEGER, type(node.op)
        if operation is ast.Div:
            return f"((double)({left}) / (double)({right}))", REAL
        if operation in ARITHMETIC:
            return f"({left} {ARITHMETIC[operation]} {right})", kind
        if kind is REAL:
            raise self._unknown(node)
        if operation in OF_INTEGERS:
            return f"({left} {OF_INTEGERS[operation]} {right})", INTEGER
        if operation in (ast.FloorDiv, ast.Mod):
            name = "quotient" if operation is ast.FloorDiv else "remainder_of"
            return f"{name}({left}, {right})", INTEGER
        raise self._unknown(node)

    def _unaryop(self, node: ast.UnaryOp) -> Typed:
        text, kind = self._written(node.operand)
        sign = {ast.USub: "-", ast.Invert: "~", ast.Not: "!"}.get(type(node.op))
        if sign is None:
            raise self._unknown(node)
        return f"({sign}({text}))", INTEGER if sign == "!" else kind

    def _boolop(self, node: ast.BoolOp) -> Typed:
        sign = " && " if isinstance(node.op, ast.And) else " || "
        return f"({sign.join(self._written(each)[0] for each in node.values)})", INTEGER

    def _compare(self, node: ast.Compare) -> Typed:
        texts = [self._written(each)[0] for each in (node.left, *node.comparators)]
        signs = [COMPARISONS[type(each)] for each in node.ops]
        pairs = zip(texts, signs, texts[1:], strict=False)
        return f"({' && '.join(f'({a} {sign} {b})' for a, sign, b in pairs)})", INTEGER

    def _ifexp(self, node: ast.IfExp) -> Typed:
        (a, first), (b, second) = self._written(node.body), self._written(node.orelse)
        kind = REAL if REAL in (first, second) else INTEGER
        return f"({self._written(node.test)[0]} ? {a} : {b})", kind

    def _call(self, node: ast.Call) -> Typed:
        name = ast.unparse(node.func)
        given = [self._written(each) for each in node.args]
        texts, kinds = [text for text, _ in given], [kind for _, kind in given]
        kind = REAL if REAL in kinds else INTEGER
        if name in self._others:
            return self._call_of(self._others[name], given)
        if name in CHOICES:
            return reduce(lambda a, b: f"{CHOICES[name]}_{kind}({a}, {b})", texts), kind
        if name == "abs":
            return f"{'fabs' if kind is REAL else 'llabs'}({texts[0]})", kind
        if name == "int":
            return f"(int64_t)({texts[0]})", INTEGER
        if name == "bool":
            return f"({texts[0]} != 0)", INTEGER
        if name.removeprefix("math.") in OF_THE_LIBRARY:
            return f"{name.removeprefix('math.')}({', '.join(texts)})", REAL
        raise self._unknown(node)

    def _call_of(self, called: KernelFunction, given: list[Typed]) -> Typed:
        """Call another function of the kernel; what it is given tells the kinds of its names."""
        self.called.add(called.name)
        missing = len(called.parameters) - len(given)
        if missing:
            given = given + [self._written(each) for each in called.defaults[-missing:]]
        for name, (_, kind) in zip(called.parameters, given, strict=True):
            called.know(name, kind)
        kind = called.result[0] if called.result else INTEGER
        return f"{called.name}({', '.join(text for text, _ in given)})", kind
