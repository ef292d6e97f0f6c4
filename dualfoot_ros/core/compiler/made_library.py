"""Making of a shared library by the C compiler of the system (``cc``).

Only a process whose cache is cold imports this.
"""

from __future__ import annotations

import platform
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from .entries import Entry
from .shared_library import PROCESSOR, Functions, load_library

COMPILER = "cc"
STANDARD = ("-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC")
FAST = ("-O3", "-march=native")
PLAIN = (("-O2",), ("-O1",))
NO_FUSING = ("-mno-fma", "-mno-fma4", "-mno-avx512f")
"""gcc 12 takes a product and a sum as one operation, of another last bit, whatever it was told."""


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
