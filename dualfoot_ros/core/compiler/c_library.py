"""The whole kernel in C, with an entry for Python in front of each of its entries.

An entry takes an array of numpy itself and reads from it where its numbers are, so that a call
costs no more than one of a function written for Python.
"""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping

from .c_function import FunctionWriter
from .entries import Entry, Kind
from .kernel_function import KernelFunction

PREFIX = "dualfoot_"
HEAD = object.__basicsize__  # bytes, of every object of Python
DATA, EXTENTS = HEAD, HEAD + 16  # where an array of numpy has its pointers

PRELUDE = f"""\
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct {{ double *x; int64_t columns; }} Rows;

/* as in Python: towards less, and as numpy has it: zero where there is nothing to divide by */
static inline int64_t quotient(int64_t a, int64_t b)
{{
    if (b == 0) return 0;
    return a / b - ((a % b != 0) && ((a < 0) != (b < 0)));
}}

static inline int64_t remainder_of(int64_t a, int64_t b)
{{
    return b == 0 ? 0 : a - b * quotient(a, b);
}}

/* the second if it is less, or greater; the first if either is no number */
static inline double less_double(double a, double b) {{ return b < a ? b : a; }}
static inline int64_t less_int64_t(int64_t a, int64_t b) {{ return b < a ? b : a; }}
static inline double greater_double(double a, double b) {{ return b > a ? b : a; }}
static inline int64_t greater_int64_t(int64_t a, int64_t b) {{ return b > a ? b : a; }}

static inline void *data(void *array)
{{
    return *(void **)((char *)array + {DATA});
}}

static inline Rows rows(void *array)
{{
    const int64_t *extents = *(int64_t **)((char *)array + {EXTENTS});
    return (Rows){{data(array), extents[1]}};
}}
"""


def library_source(
    functions: Mapping[str, types.FunctionType], entries: Mapping[str, Entry]
) -> str:
    """Return the text in C of the ``entries`` among ``functions`` and all that they call.

    Raises
    ------
    TranslationError
        When a function does what has no translation.
    """
    known = {name: KernelFunction(function) for name, function in functions.items()}
    for name, entry in entries.items():
        for parameter, kind in zip(known[name].parameters, entry.parameters, strict=True):
            known[name].know(parameter, kind)
    written: dict[str, str] = {}
    while written != (again := _write(known, entries)):
        written = again
    results = [_result(known[name]) for name in written if len(known[name].result) > 1]
    heads = [f"{known[name].head};" for name in written]
    adapters = [_adapter(name, entry) for name, entry in entries.items()]
    return "\n".join([PRELUDE, *results, *heads, "", *written.values(), *adapters])


def _write(known: Mapping[str, KernelFunction], entries: Mapping[str, Entry]) -> dict[str, str]:
    """Return the text of every function that is called, by name."""
    written: dict[str, str] = {}
    waiting = list(entries)
    while waiting:
        name = waiting.pop()
        if name not in written:
            writer = FunctionWriter(known[name], known)
            written[name] = writer.definition()
            waiting += sorted(writer.called)
    return written


def _result(function: KernelFunction) -> str:
    """Return the type of what a function with several results returns."""
    fields = " ".join(f"{kind} x{k};" for k, kind in enumerate(function.result))
    return f"{function.returned} {{ {fields} }};"


def _adapter(name: str, entry: Entry) -> str:
    """Return the function that Python calls."""
    given = ", ".join(f"{_foreign(kind)}a{k}" for k, kind in enumerate(entry.parameters))
    passed = ", ".join(_unpacked(entry.parameters))
    call = f"{'return ' if entry.result else ''}{name}({passed});"
    return f"{entry.result or 'void'} {PREFIX}{name}({given})\n{{\n    {call}\n}}\n"


def _foreign(kind: Kind) -> str:
    return "void *" if kind.is_array else f"{kind} "


def _unpacked(kinds: tuple[Kind, ...]) -> Iterator[str]:
    for k, kind in enumerate(kinds):
        if kind is Kind.ROWS:
            yield f"rows(a{k})"
        else:
            yield f"data(a{k})" if kind.is_array else f"a{k}"
