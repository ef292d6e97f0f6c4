"""A function of the kernel in C, statement by statement.

The kernel is written in a small part of Python: numbers, arrays that are read and written number
by number, loops over `range`, and calls of each other.  Whatever is not of that part is refused.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence

from .c_expressions import ExpressionWriter, Typed
from .kernel_function import INTEGER, KernelFunction
from .texts_in_c import HAS_VECTORS, TEXTS

LANES = "lanes"  # of the kernel's layout: a range whose numbers can be taken several at once
WRITTEN_OUT = 8  # turns of a loop that gcc writes out


class FunctionWriter(ExpressionWriter):
    """Writes a function, and learns the kinds of its names on the way.

    What is written counts once another round learns nothing new.
    """

    def __init__(self, function: KernelFunction, others: Mapping[str, KernelFunction]) -> None:
        """Write ``function``, which may call ``others``."""
        super().__init__(function, others)
        self._temporaries = 0

    def definition(self) -> str:
        """Return the whole function."""
        body = list(self._block(self._function.body))
        own = self._function
        local = [f"{kind} {name};" for name, kind in own.kinds.items() if self._is_local(name)]
        lines = "\n".join("    " + line for line in [*local, *body]) + "\n"
        text = TEXTS.get(own.name)
        if text is not None:
            lines = f"#ifdef {HAS_VECTORS}\n{text}#else\n{lines}#endif\n"
        return f"{own.head}\n{{\n{lines}}}\n"

    def _is_local(self, name: str) -> bool:
        return name not in self._function.parameters

    def _block(self, nodes: Sequence[ast.stmt]) -> Iterator[str]:
        for node in nodes:
            yield from self._written(node)

    def _expr(self, node: ast.Expr) -> Iterator[str]:
        if not isinstance(node.value, ast.Constant):  # a docstring
            yield f"{self._written(node.value)[0]};"

    def _assign(self, node: ast.Assign) -> Iterator[str]:
        (target,) = node.targets
        if not isinstance(target, ast.Tuple):
            yield self._put(target, self._written(node.value))
        elif isinstance(node.value, ast.Tuple):
            values = [self._written(each) for each in node.value.elts]
            names = [self._temporary() for _ in values]
            for name, (text, kind) in zip(names, values, strict=True):
                yield f"{kind} {name} = {text};"
            for each, name, (_, kind) in zip(target.elts, names, values, strict=True):
                yield self._put(each, (name, kind))
        else:
            yield from self._take_apart(target, node.value)

    def _take_apart(self, target: ast.Tuple, value: ast.expr) -> Iterator[str]:
        """Assign what a function with several results returns."""
        assert isinstance(value, ast.Call)
        called = self._others[ast.unparse(value.func)]
        name, (text, _) = self._temporary(), self._written(value)
        yield f"{called.returned} {name} = {text};"
        kinds = called.result or [INTEGER] * len(target.elts)
        for k, (each, kind) in enumerate(zip(target.elts, kinds, strict=True)):
            yield self._put(each, (f"{name}.x{k}", kind))

    def _temporary(self) -> str:
        self._temporaries += 1
        return f"value_{self._temporaries}"

    def _put(self, target: ast.expr, value: Typed) -> str:
        if isinstance(target, ast.Name):
            self._function.know(target.id, value[1])
        return f"{self._written(target)[0]} = {value[0]};"

    def _augassign(self, node: ast.AugAssign) -> Iterator[str]:
        yield self._put(node.target, self._binop(ast.BinOp(node.target, node.op, node.value)))

    def _for(self, node: ast.For) -> Iterator[str]:
        assert isinstance(node.target, ast.Name)
        counter, end = self._temporary(), self._temporary()
        if isinstance(node.iter, ast.Tuple):
            values = ", ".join(self._written(each)[0] for each in node.iter.elts)
            first, stop, step = "0", str(len(node.iter.elts)), "1"
            taken = f"(const int64_t[]){{{values}}}[{counter}]"
        else:
            first, stop, step = self._range(node.iter)
            taken = counter
        yield from self._hints(node, first, stop)
        yield f"for (int64_t {counter} = {first}, {end} = {stop}; {counter} < {end};"
        yield f"     {counter} += {step}) {{"
        yield "    " + self._put(node.target, (taken, INTEGER))
        yield from self._indented(node.body)
        yield "}"

    def _range(self, node: ast.expr) -> tuple[str, str, str]:
        """Return start, stop and step of a range that goes up."""
        if not isinstance(node, ast.Call) or ast.unparse(node.func) not in {"range", LANES}:
            raise self._unknown(node)
        bounds = [self._written(each)[0] for each in node.args]
        if len(bounds) == 1:
            bounds = ["0", *bounds]
        return bounds[0], bounds[1], bounds[2] if len(bounds) > 2 else "1"

    def _hints(self, node: ast.For, first: str, stop: str) -> Iterator[str]:
        """Tell the compiler what `lanes` says: no turn of the loop needs another one.

        A short loop it would write out, turn by turn, before it looks for what goes at once.
        """
        if isinstance(node.iter, ast.Call) and ast.unparse(node.iter.func) == LANES:
            yield "#pragma GCC ivdep"
            if first.isdigit() and stop.isdigit() and int(stop) - int(first) <= WRITTEN_OUT:
                yield "#pragma GCC unroll 1"

    def _indented(self, nodes: Sequence[ast.stmt]) -> Iterator[str]:
        for line in self._block(nodes):
            yield "    " + line

    def _while(self, node: ast.While) -> Iterator[str]:
        yield f"while ({self._written(node.test)[0]}) {{"
        yield from self._indented(node.body)
        yield "}"

    def _if(self, node: ast.If) -> Iterator[str]:
        yield f"if ({self._written(node.test)[0]}) {{"
        yield from self._indented(node.body)
        if node.orelse:
            yield "} else {"
            yield from self._indented(node.orelse)
        yield "}"

    def _break(self, _node: ast.Break) -> Iterator[str]:
        yield "break;"

    def _continue(self, _node: ast.Continue) -> Iterator[str]:
        yield "continue;"

    def _return(self, node: ast.Return) -> Iterator[str]:
        if node.value is None:
            yield "return;"
            return
        several = isinstance(node.value, ast.Tuple)
        parts = node.value.elts if isinstance(node.value, ast.Tuple) else [node.value]
        values = [self._written(each) for each in parts]
        self._function.returns([kind for _, kind in values])
        texts = ", ".join(text for text, _ in values)
        yield f"return ({self._function.returned}){{{texts}}};" if several else f"return {texts};"
