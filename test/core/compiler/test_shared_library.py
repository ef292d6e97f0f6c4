"""The kernel as a library: made, loaded, refused where it is no good, and not needed anywhere."""

import importlib
import importlib.util
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import pytest

from dualfoot_ros.core.compiler import array_layout, c_library, made_library, shared_library
from dualfoot_ros.core.compiler.c_library import library_source
from dualfoot_ros.core.compiler.entries import ENTRY_KINDS, Entry, Kind
from dualfoot_ros.core.compiler.made_library import make_library
from dualfoot_ros.core.compiler.shared_library import library_path, load_library
from dualfoot_ros.core.kernel import ENTRIES, interpreted, kernel_functions
from dualfoot_ros.core.kernel import layout as lay

kept_library = importlib.import_module("dualfoot_ros.core.compiler.kept_library")
FEW = {name: ENTRY_KINDS[name] for name in ("restore", "set_flags")}

pytestmark = pytest.mark.skipif(
    not made_library.can_compile(), reason="needs a C compiler (cc), on Linux"
)


@pytest.fixture(scope="module")
def source():
    """Return some entries in C."""
    return library_source(kernel_functions(), FEW)


@pytest.fixture(scope="module")
def file(source, tmp_path_factory):
    """Return the library of these entries."""
    path = library_path(tmp_path_factory.mktemp("library"), "kernel")
    assert set(make_library(path, source, FEW, bool)) == set(FEW)
    assert [each.name for each in path.parent.iterdir()] == [path.name]
    return path


def kept(directory, is_good=bool):
    """Return these entries of a library that is kept in a directory."""
    return kept_library.kept_library(directory, "kernel", kernel_functions(), FEW, is_good)


def test_every_entry_says_what_it_takes():
    functions = kernel_functions()
    assert list(ENTRY_KINDS) == list(ENTRIES)
    for name, entry in ENTRY_KINDS.items():
        assert functions[name].__code__.co_argcount == len(entry.parameters)


def test_the_library_is_loaded_without_numba(file):
    script = (
        "import sys; from pathlib import Path\n"
        "from dualfoot_ros.core.compiler.entries import ENTRY_KINDS\n"
        "from dualfoot_ros.core.compiler.shared_library import load_library\n"
        "few = {name: ENTRY_KINDS[name] for name in ('restore', 'set_flags')}\n"
        f"found = load_library(Path({str(file)!r}), few)\n"
        "print(sorted(found), [m for m in ('numba', 'llvmlite') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == f"{sorted(FEW)} []"


@pytest.mark.parametrize("damage", [b"", b"no library", None])
def test_a_library_that_cannot_be_loaded_is_none(file, tmp_path, damage):
    path = tmp_path / file.name
    if damage is not None:
        path.write_bytes(damage)
    assert load_library(path, FEW) is None


def test_a_library_that_lacks_an_entry_is_none(file):
    assert load_library(file, ENTRY_KINDS) is None


def test_arrays_of_another_kind_are_none_of_the_library(file, monkeypatch):
    monkeypatch.setattr(array_layout, "DATA", array_layout.DATA + 8)
    assert load_library(file, FEW) is None


def test_another_processor_has_another_library(tmp_path, monkeypatch):
    here = library_path(tmp_path, "kernel")
    monkeypatch.setattr(shared_library, "_processor", lambda: "another one")
    assert library_path(tmp_path, "kernel") != here


def test_a_compiler_that_does_not_know_the_best_options_gets_others(source, tmp_path, monkeypatch):
    monkeypatch.setattr(made_library, "FAST", ("--no-such-option",))
    path = library_path(tmp_path, "kernel")
    assert make_library(path, source, FEW, bool)
    assert load_library(path, FEW)


def test_options_that_give_other_bits_are_followed_by_others(source, tmp_path):
    path, looked = library_path(tmp_path, "kernel"), []
    assert make_library(path, source, FEW, lambda made: looked.append(made) or len(looked) == 3)
    assert len(looked) == 3
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


def test_where_nothing_can_be_made_numba_is_asked_and_the_next_time_at_once(tmp_path, monkeypatch):
    made, make = [], make_library
    monkeypatch.setattr(made_library, "make_library", lambda *a: made.append(1) or make(*a))
    monkeypatch.setattr(made_library, "COMPILER", shutil.which("false"))
    assert kept(tmp_path) is None
    assert kept(tmp_path) is None
    assert made == [1]


def test_a_library_with_other_bits_is_not_used_now_or_later(tmp_path):
    assert kept(tmp_path, is_good=lambda _functions: False) is None
    assert library_path(tmp_path, "kernel").read_bytes() == b""
    assert kept(tmp_path) is None


@pytest.mark.parametrize("lacks", ["a compiler", "Linux"])
def test_without_a_compiler_nothing_is_tried(tmp_path, monkeypatch, lacks):
    if lacks == "Linux":
        monkeypatch.setattr(made_library, "PROCESSOR", tmp_path / "none")
    else:
        monkeypatch.setattr(made_library, "COMPILER", "no-such-compiler")
    monkeypatch.setattr(c_library, "library_source", lambda *_: pytest.fail("translated"))
    assert kept(tmp_path) is None
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_nothing_is_raised(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "TemporaryDirectory", _folder_in(tmp_path / "gone"))
    assert kept(tmp_path / "gone") is None


@pytest.mark.parametrize("kept_in", [None, "gone"])
def test_a_library_that_is_kept_nowhere_leaves_no_file(tmp_path, monkeypatch, kept_in):
    monkeypatch.setattr(tempfile, "TemporaryDirectory", _folder_in(tmp_path))
    functions = kept(kept_in and tmp_path / kept_in)
    assert list(tmp_path.iterdir()) == []
    flags = []
    for set_flags in (functions["set_flags"], interpreted().set_flags):
        n = np.zeros(lay.integer_size(16), dtype=np.int64)
        n[lay.N_RING] = 16
        set_flags(n, 1, 3, 9, True)
        flags.append(n[lay.N_FLAGS :].tolist())
    assert sum(flags[0]) == 2 * 7 and flags[0] == flags[1]


def _folder_in(path):
    """Return what makes temporary folders in ``path``, where no other is asked for."""
    make = tempfile.TemporaryDirectory
    return lambda **given: make(**{"dir": path, **given})


def test_other_functions_have_a_library_of_their_own_named_by_what_they_are(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALFOOT_CACHE_DIR", str(tmp_path / "cache"))
    entries = {"times": Entry((Kind.INTEGER,), Kind.INTEGER)}
    for factor in (2, 3, 2):
        file = tmp_path / f"numbers_{factor}.py"
        file.write_text(f"FACTOR = {factor}\n\n\ndef times(x):\n    return FACTOR * x\n")
        spec = importlib.util.spec_from_file_location("numbers", file)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        assert kept_library.compiled_module(module, entries, bool)["times"](7) == 7 * factor
    assert len(list((tmp_path / "cache").rglob("numbers-*.so"))) == 2
