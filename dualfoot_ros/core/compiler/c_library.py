"""The whole kernel in C, with an entry for Python in front of each of its entries.

An entry is a function of Python itself (METH_FASTCALL): it gets objects, and reads from an array
of numpy where its numbers are.  A call takes 0.1 us.  By way of ctypes, which makes an object of
each argument first, one with five arrays took 0.8 us: half as much as the epoch it was for.
"""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping

from .array_layout import ALIGNED, DATA, EXTENTS, FLAGS, NUMBERS, RANK, STRIDES, TYPE
from .c_function import FunctionWriter
from .entries import PREFIX, Entry, Kind
from .kernel_function import KernelFunction
from .texts_in_c import VECTORS

PRELUDE = f"""\
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct {{ double *x; int64_t columns; }} Rows;

extern long long PyLong_AsLongLong(void *);
extern double PyFloat_AsDouble(void *);
extern void *PyLong_FromLongLong(long long);
extern void *PyFloat_FromDouble(double);
extern void *Py_BuildValue(const char *, ...);
extern void *PyExc_TypeError;
extern void PyErr_SetString(void *, const char *);
extern void *PyErr_Occurred(void);
extern void PyErr_Clear(void);

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

/* what an object holds, so many bytes from its start */
#define HELD(type, object, place) (*(type *)((char *)(object) + (place)))

/* whether an object is an array of 12 double, one after the other; the second one is of double */
static inline int is_sample(void *given, void *doubles)
{{
    return HELD(void *, given, {TYPE}) == HELD(void *, doubles, {TYPE})
        && HELD(void *, given, {NUMBERS}) == HELD(void *, doubles, {NUMBERS})
        && HELD(int, given, {RANK}) == 1
        && HELD(int64_t *, given, {EXTENTS})[0] == 12
        && HELD(int64_t *, given, {STRIDES})[0] == sizeof(double)
        && (HELD(int, given, {FLAGS}) & {ALIGNED});
}}

static inline int is_integer(void *given)
{{
    if (PyLong_AsLongLong(given) != -1 || !PyErr_Occurred()) return 1;
    PyErr_Clear();
    return 0;
}}
"""

TAKEN = {
    Kind.INTEGER: "PyLong_AsLongLong",
    Kind.REAL: "PyFloat_AsDouble",
    Kind.INTEGERS: "data",
    Kind.REALS: "data",
    Kind.ROWS: "rows",
    Kind.SAMPLE: "data",
    Kind.BYTES: "data",
}
LOOKED_AT = {Kind.INTEGER: "is_integer(a[{k}])", Kind.SAMPLE: "is_sample(a[{k}], a[0])"}
MADE = {Kind.INTEGER: "PyLong_FromLongLong", Kind.REAL: "PyFloat_FromDouble"}
NONE = 'return Py_BuildValue("");'
ADAPTER = """\
void *{name}(void *self, void *const *a, int64_t count)
{{
    if (count != {count}) {{
        PyErr_SetString(PyExc_TypeError, "{name} takes {count} arguments");
        return 0;
    }}{looked_at}
    {returned}
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
    return "\n".join([PRELUDE, VECTORS, *results, *heads, "", *written.values(), *adapters])


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
    call = f"{name}({', '.join(_unpacked(entry.parameters))})"
    returned = f"return {MADE[entry.result]}({call});" if entry.result else f"{call};\n    {NONE}"
    return ADAPTER.format(
        name=PREFIX + name,
        count=len(entry.parameters),
        looked_at=_looked_at(entry.parameters),
        returned=returned,
    )


def _looked_at(kinds: tuple[Kind, ...]) -> str:
    """Return what an entry that takes a sample from outside does first."""
    if Kind.SAMPLE not in kinds:
        return ""
    checks = [LOOKED_AT[kind].format(k=k) for k, kind in enumerate(kinds) if kind in LOOKED_AT]
    return f"\n    if (!({' && '.join(checks)})) return PyLong_FromLongLong(0);"


def _unpacked(kinds: tuple[Kind, ...]) -> Iterator[str]:
    for k, kind in enumerate(kinds):
        yield f"{TAKEN[kind]}(a[{k}])"
