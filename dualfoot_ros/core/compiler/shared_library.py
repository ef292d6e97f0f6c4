"""The kernel as a shared library: the C compiler of the system (``cc``) makes it, 5 ms load it."""

from __future__ import annotations

import ctypes
import hashlib
import platform
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .c_library import DATA, EXTENTS, FLAGS, NUMBERS, PREFIX, RANK, STRIDES, TYPE
from .entries import Entry

COMPILER = "cc"
PROCESSOR = Path("/proc/cpuinfo")  # of Linux alone
STANDARD = ("-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC")
FAST = ("-O3", "-march=native")
PLAIN = (("-O2",), ("-O1",))
NO_FUSING = ("-mno-fma", "-mno-fma4", "-mno-avx512f")
"""gcc 12 takes a product and a sum as one operation, of another last bit, whatever it was told."""

FASTCALL = 0x80  # METH_FASTCALL of Python
Functions = dict[str, Callable[..., Any]]


class _Definition(ctypes.Structure):
    """What Python knows of a function that is written in C: its PyMethodDef."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("code", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("text", ctypes.c_char_p),
    )


_kept: list[_Definition] = []  # a function of Python does not own its definition


def library_path(directory: Path, name: str) -> Path:
    """Return the path of a library for this processor; a home may be that of many machines."""
    key = hashlib.sha256(_processor().encode()).hexdigest()[:16]
    return directory / f"{name}-{key}.so"


def _processor() -> str:
    """Return what the machine code depends on: the instructions that the processor knows."""
    text = PROCESSOR.read_text(encoding="utf-8") if PROCESSOR.exists() else ""
    starts = ("flags", "Features", "model name")
    known = {line for line in text.splitlines() if line.startswith(starts)}
    return f"{platform.machine()} {sorted(known)}"


def can_compile() -> bool:
    """Return whether a library can be made here: on Linux, with a C compiler."""
    return PROCESSOR.exists() and bool(shutil.which(COMPILER))


def make_library(
    path: Path, source: str, entries: Mapping[str, Entry], is_good: Callable[[Functions], bool]
) -> Functions | None:
    """Make the library of a ``source`` in C; return its ``entries`` by name.

    It is at ``path`` once ``is_good`` has said that its entries are.  None where no options of the
    compiler give such a library.
    """
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        code = Path(folder) / "library.c"
        code.write_text(source, encoding="ascii")
        for k, options in enumerate(_options()):
            made = Path(folder) / f"{k}.so"  # each has its own name: a loaded one stays loaded
            command = [COMPILER, *options, *STANDARD, "-o", str(made), str(code), "-lm"]
            if subprocess.run(command, check=False, capture_output=True).returncode:
                continue
            functions = load_library(made, entries)
            if functions is not None and is_good(functions):
                made.replace(path)
                return functions
    return None


def _options() -> tuple[tuple[str, ...], ...]:
    """Return options of the compiler, the fastest first; not every one knows all of them."""
    if platform.machine() in {"x86_64", "AMD64"}:
        return (*FAST, *NO_FUSING), *PLAIN
    return FAST, *PLAIN


def load_library(path: Path, entries: Mapping[str, Entry]) -> Functions | None:
    """Return the ``entries`` in a library by name; None where it cannot be used.

    They take what stands in ``entries`` and do not look whether an array is one.
    """
    if not path.exists() or not _knows_arrays():
        return None
    try:
        library = ctypes.PyDLL(str(path))
        return {name: _function(library, PREFIX + name) for name in entries}
    except (OSError, AttributeError):  # no right to execute, a damaged file
        return None


def _knows_arrays() -> bool:
    """Return whether an array of numpy has all that is looked for in its place."""
    array = np.zeros((3, 5))

    def held(kind: type[Any], place: int) -> Any:
        return kind.from_address(id(array) + place).value

    pointers = [held(ctypes.c_void_p, place) for place in (DATA, TYPE, NUMBERS)]
    if pointers != [array.ctypes.data, id(np.ndarray), id(array.dtype)]:
        return False
    if (held(ctypes.c_int, RANK), held(ctypes.c_int, FLAGS)) != (2, array.flags.num):
        return False
    pairs = [held(ctypes.c_void_p, place) for place in (EXTENTS, STRIDES)]
    if None in pairs:
        return False
    found = [tuple((ctypes.c_int64 * 2).from_address(place)) for place in pairs]
    return found == [array.shape, array.strides]


def _function(library: ctypes.PyDLL, name: str) -> Callable[..., Any]:
    """Return a function of the library as one of Python, which ctypes takes no part in."""
    code = ctypes.cast(library[name], ctypes.c_void_p)
    _kept.append(_Definition(name.encode(), code.value, FASTCALL, None))
    make = ctypes.PYFUNCTYPE(
        ctypes.py_object, ctypes.POINTER(_Definition), ctypes.c_void_p, ctypes.c_void_p
    )(("PyCFunction_NewEx", ctypes.pythonapi))
    function: Callable[..., Any] = make(ctypes.byref(_kept[-1]), None, None)
    return function
