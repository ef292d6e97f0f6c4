"""The kernel as a shared library (:mod:`.made_library` makes it), which 5 ms load."""

from __future__ import annotations

import ctypes
import hashlib
import platform
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from .array_layout import knows_arrays
from .entries import PREFIX, Entry

PROCESSOR = Path("/proc/cpuinfo")  # of Linux alone
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


def load_library(path: Path, entries: Mapping[str, Entry]) -> Functions | None:
    """Return the ``entries`` in a library by name; None where it cannot be used.

    They take what stands in ``entries`` and do not look whether an array is one.
    """
    if not path.exists() or not knows_arrays():
        return None
    try:
        library = ctypes.PyDLL(str(path))
        return {name: _function(library, PREFIX + name) for name in entries}
    except (OSError, AttributeError):  # no right to execute, a damaged file
        return None


def _function(library: ctypes.PyDLL, name: str) -> Callable[..., Any]:
    """Return a function of the library as one of Python, which ctypes takes no part in."""
    code = ctypes.cast(library[name], ctypes.c_void_p)
    _kept.append(_Definition(name.encode(), code.value, FASTCALL, None))
    make = ctypes.PYFUNCTYPE(
        ctypes.py_object, ctypes.POINTER(_Definition), ctypes.c_void_p, ctypes.c_void_p
    )(("PyCFunction_NewEx", ctypes.pythonapi))
    function: Callable[..., Any] = make(ctypes.byref(_kept[-1]), None, None)
    return function
