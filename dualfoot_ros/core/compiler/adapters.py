"""Plain functions in front of the entries of the kernel, as text for LLVM.

numba passes an array as seven numbers or nine; these take the array object itself and read from it
where its numbers are.  So a call from Python costs no more than one of numba's own functions.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

PREFIX = "dualfoot_"
TABLE = PREFIX + "entries"  # name of the text that lists the entries, one a line
HEAD = object.__basicsize__  # bytes, of every object of Python
DATA, DIMENSIONS = HEAD, HEAD + 16  # where an array of numpy has its pointers
ITEM = 8  # bytes; all numbers of the kernel have as many
SCALARS = {"i": "i64", "b": "i8", "d": "double"}
UNREACHED = "define void @NRT_MemInfo_call_dtor(ptr %0) {\n  ret void\n}\n"
"""What numba would call for an array that nobody holds any more; the caller holds all of them."""

OPAQUE = 17  # version of LLVM from which no pointer says what it points to


@dataclass(frozen=True)
class Entry:
    """An entry of the kernel.

    Attributes
    ----------
    result : "i" (int64), "d" (float64) or "n" (none)
    arguments : a letter each: "v" (array of one dimension), "m" (of two, row by row), "i", "b"
        (truth) or "d"
    """

    name: str
    result: str
    arguments: str

    @classmethod
    def read(cls, line: str) -> Entry:
        """Return the entry that a line of the table describes."""
        return cls(*line.split(" "))

    def __str__(self) -> str:
        """Return a line of the table."""
        return f"{self.name} {self.result} {self.arguments}"


def adapter_text(entries: Mapping[Entry, str], version: int) -> str:
    """Return a module for LLVM ``version`` with a function for each of ``entries``.

    ``entries`` gives the symbol of each.
    """
    table = "\n".join(map(str, entries))
    data = table.encode().hex(" ").upper().split()
    text = "".join(rf"\{byte}" for byte in [*data, "00"])
    functions = [_function(entry, symbol) for entry, symbol in entries.items()]
    size = len(data) + 1
    module = [f'@{TABLE} = constant [{size} x i8] c"{text}"', UNREACHED, *functions]
    return _spell("\n".join(module), version)


def _spell(text: str, version: int) -> str:
    """Return ``text``, where ptr<T> is a pointer to T, as LLVM ``version`` spells pointers."""
    if version >= OPAQUE:
        return re.sub(r"ptr<\w+>", "ptr", text)
    typed = re.sub(r"ptr<(\w+)>", r"\1*", text)
    return re.sub(r"\bptr\b", "i8*", typed)


def _function(entry: Entry, symbol: str) -> str:
    """Return the function ``int dualfoot_NAME(result *, arguments)``; not 0 says it has failed."""
    given, passed = ["ptr %result"], ["ptr %result", "ptr %error"]
    body = ["%error.at = alloca ptr", "%error = bitcast ptr<ptr> %error.at to ptr"]
    for k, kind in enumerate(entry.arguments):
        if kind in SCALARS:
            given.append(f"{SCALARS[kind]} %a{k}")
            passed.append(given[-1])
        else:
            given.append(f"ptr %a{k}")
            body += _unpack(f"%a{k}", 2 if kind == "m" else 1)
            passed += _fields(f"%a{k}", 2 if kind == "m" else 1)
    types = ", ".join(each.split()[0] for each in passed)
    body += [f'%status = call i32 @"{symbol}"({", ".join(passed)})', "ret i32 %status"]
    lines = "".join(f"  {line}\n" for line in body)
    head = f"define i32 @{PREFIX}{entry.name}({', '.join(given)})"
    return f'declare i32 @"{symbol}"({types})\n{head} {{\n{lines}}}\n'


def _unpack(array: str, dimensions: int) -> Iterator[str]:
    """Yield what reads the address and the extents of an array."""
    yield from _load(f"{array}.data", "ptr", array, DATA)
    yield from _load(f"{array}.extents", "ptr", array, DIMENSIONS)
    yield from _load(f"{array}.n0", "i64", f"{array}.extents", 0)
    if dimensions == 2:
        yield from _load(f"{array}.n1", "i64", f"{array}.extents", ITEM)
        yield f"{array}.size = mul i64 {array}.n0, {array}.n1"
        yield f"{array}.row = mul i64 {array}.n1, {ITEM}"


def _load(name: str, kind: str, start: str, offset: int) -> Iterator[str]:
    """Yield what reads a value of ``kind``, ``offset`` bytes behind ``start``."""
    yield f"{name}.byte = getelementptr i8, ptr {start}, i64 {offset}"
    yield f"{name}.at = bitcast ptr {name}.byte to ptr<{kind}>"
    yield f"{name} = load {kind}, ptr<{kind}> {name}.at"


def _fields(array: str, dimensions: int) -> list[str]:
    """Return an array as numba passes it: owner, size, address, extents, steps in bytes."""
    if dimensions == 1:
        size, extents, steps = f"{array}.n0", [f"{array}.n0"], [str(ITEM)]
    else:
        size = f"{array}.size"
        extents, steps = [f"{array}.n0", f"{array}.n1"], [f"{array}.row", str(ITEM)]
    owner = ["ptr null", "ptr null"]
    numbers = [f"i64 {each}" for each in (size, ITEM)]
    rest = [f"i64 {each}" for each in (*extents, *steps)]
    return [*owner, *numbers, f"ptr {array}.data", *rest]
