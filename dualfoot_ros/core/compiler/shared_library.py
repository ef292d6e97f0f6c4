"""The compiled kernel as a shared library: loaded without numba, which takes 130 MB and 0.6 s.

LLVM, which numba brings, writes the machine code that it would run itself into an object file, and
the C compiler of the system (``cc``) links it.  Where there is none, numba loads the kernel.
"""

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

from .adapters import DATA, DIMENSIONS, PREFIX, TABLE, Entry, adapter_text

LINKER = "cc"
PROCESSOR = Path("/proc/cpuinfo")  # of Linux alone
OPTIONS = ("-shared", "-nostartfiles", "-Wl,-z,defs")
RESULTS: dict[str, Any] = {"i": ctypes.c_int64, "d": ctypes.c_double, "n": ctypes.c_void_p}
ARGUMENTS: dict[str, Any] = {
    "v": ctypes.py_object,
    "m": ctypes.py_object,
    "i": ctypes.c_int64,
    "b": ctypes.c_bool,
    "d": ctypes.c_double,
}


def library_path(directory: Path) -> Path:
    """Return the path of the kernel for this processor; a home may be that of many machines."""
    key = hashlib.sha256(_processor().encode()).hexdigest()[:16]
    return directory / f"kernel-{key}.so"


def _processor() -> str:
    """Return what the machine code depends on: the instructions that the processor knows."""
    text = PROCESSOR.read_text(encoding="utf-8") if PROCESSOR.exists() else ""
    starts = ("flags", "Features", "model name")
    known = {line for line in text.splitlines() if line.startswith(starts)}
    return f"{platform.machine()} {sorted(known)}"


def can_link() -> bool:
    """Return whether a library can be made here: on Linux, with a C compiler."""
    return PROCESSOR.exists() and bool(shutil.which(LINKER))


def write_library(path: Path, entries: Mapping[Entry, Any]) -> bool:
    """Write the library of ``entries`` with what numba has compiled of each (a CompileResult).

    Returns whether it could be linked.
    """
    try:
        machine_code = _object_code(entries)
    except (AttributeError, RuntimeError):  # another numba, or another LLVM
        return False
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        code, made = Path(folder) / "kernel.o", Path(folder) / path.name
        code.write_bytes(machine_code)
        command = [LINKER, *OPTIONS, "-o", str(made), str(code), "-lm", "-lc"]
        done = subprocess.run(command, check=False, capture_output=True)
        if done.returncode == 0:
            made.replace(path)
    return done.returncode == 0


def _object_code(entries: Mapping[Entry, Any]) -> bytes:
    """Return the machine code as LLVM writes it for a library: at any address."""
    from numba.core.codegen import ll as binding  # its llvmlite

    symbols = {entry: done.fndesc.llvm_func_name for entry, done in entries.items()}
    text = adapter_text(symbols, binding.llvm_version_info[0])
    module = binding.parse_assembly(text)
    for done in entries.values():
        # The module with all that the entry calls, optimized: what numba runs.
        bitcode = done.library._final_module.as_bitcode()  # noqa: SLF001  (numba has no other way)
        module.link_in(binding.parse_bitcode(bitcode))
        triple, processor, features = done.library.codegen.magic_tuple()
    target = binding.Target.from_triple(triple).create_target_machine(
        cpu=processor, features=features, opt=3, reloc="pic", codemodel="default"
    )
    code: bytes = target.emit_object(module)
    return code


def load_library(path: Path) -> dict[str, Callable[..., Any]] | None:
    """Return the entries in a library by name; None where it cannot be used."""
    if not path.exists() or not _knows_arrays():
        return None
    try:
        library = ctypes.PyDLL(str(path))  # which keeps the lock of the interpreter, as numba does
        table = ctypes.string_at(ctypes.addressof(ctypes.c_char.in_dll(library, TABLE)))
    except (OSError, ValueError):  # a folder without the right to execute, a damaged file
        return None
    entries = [Entry.read(line) for line in table.decode().splitlines()]
    return {e.name: _callable(getattr(library, PREFIX + e.name), e) for e in entries}


def _knows_arrays() -> bool:
    """Return whether an array of numpy has its address and extents where they are looked for."""
    array = np.zeros((3, 5))
    found = ctypes.c_void_p.from_address(id(array) + DATA).value
    extents = ctypes.c_void_p.from_address(id(array) + DIMENSIONS).value
    if found != array.ctypes.data or extents is None:
        return False
    return tuple((ctypes.c_int64 * 2).from_address(extents)) == array.shape


def _callable(function: Any, entry: Entry) -> Callable[..., Any]:
    """Return an entry as a function of Python, which raises as the kernel in Python does."""
    kind = RESULTS[entry.result]
    function.argtypes = [ctypes.c_void_p, *(ARGUMENTS[each] for each in entry.arguments)]
    nothing = entry.result == "n"

    def call(*arguments: Any) -> Any:
        result = kind()
        if function(ctypes.byref(result), *arguments):
            raise ZeroDivisionError(f"division by zero in '{entry.name}' of the kernel")
        return None if nothing else result.value

    return call
