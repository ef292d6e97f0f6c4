"""The kernel as a library has the bits of the kernel in Python, and is not needed anywhere."""

import importlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

from dualfoot_ros.core.compiler import shared_library
from dualfoot_ros.core.compiler.adapters import Entry
from dualfoot_ros.core.compiler.shared_library import library_path, load_library, write_library
from dualfoot_ros.core.kernel import ENTRIES, interpreted
from dualfoot_ros.core.kernel import layout as lay

compiled_kernel = importlib.import_module("dualfoot_ros.core.compiler.compiled")
RING = 16
FEW = ("restore", "set_flags", "emit", "collect", "correct", "turn")  # all kinds of arguments

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("numba") is None or not shared_library.can_link(),
    reason="needs numba and a C compiler (cc), on Linux",
)


@pytest.fixture(scope="module")
def code():
    """Return what numba makes of some entries."""
    few = {name: kinds for name, kinds in compiled_kernel._signatures().items() if name in FEW}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(compiled_kernel, "_signatures", lambda: few)
        return compiled_kernel._machine_code()


@pytest.fixture(scope="module")
def file(code, tmp_path_factory):
    """Return the library of these entries."""
    path = library_path(tmp_path_factory.mktemp("library"))
    assert write_library(path, code)
    assert [each.name for each in path.parent.iterdir()] == [path.name]
    return path


@pytest.fixture
def space():
    """Return the two arrays of the kernel, with numbers that a filter could have."""
    rng = np.random.default_rng(5)
    n = np.zeros(lay.integer_size(RING), dtype=np.int64)
    n[lay.N_RING], n[lay.N_EPOCH] = RING, 5
    w = rng.normal(size=lay.RINGS + RING * (lay.SAMPLE + lay.STATE))
    for at in range(3):
        w[lay.S_S + 4 * at] += 10.0
    return w, n


CALLS = {
    "restore": lambda f, w, n: f(w, n, 3),
    "set_flags": lambda f, w, n: f(n, 1, 3, 9, True),
    "emit": lambda f, w, n: f(w, n, w[-2 * lay.OUT :].reshape(2, lay.OUT), 1),
    "collect": lambda f, w, n: f(w, 2),
    "correct": lambda f, w, n: f(w, 3),
    "turn": lambda f, w, n: f(w, 0, 1, 0.6, 0.8, w[-3:], w[-6:-3]),
}


@pytest.mark.parametrize("name", FEW)
def test_an_entry_of_the_library_has_the_bits_of_the_kernel_in_python(file, space, name):
    found = []
    for function in (load_library(file)[name], getattr(interpreted(), name)):
        w, n = space[0].copy(), space[1].copy()
        result = CALLS[name](function, w, n)
        found.append((w.tobytes(), n.tobytes(), result))
    assert found[0] == found[1]
    assert found[0][:2] != (space[0].tobytes(), space[1].tobytes())


def inverse(w, k):
    return 1.0 / w[k]


def test_a_division_by_zero_is_an_exception(tmp_path):
    from numba import float64, int64, njit

    compiled = njit(no_cpython_wrapper=True, no_cfunc_wrapper=True)(inverse)
    kinds = float64(float64[::1], int64)
    compiled.compile(kinds)
    path, entry = library_path(tmp_path), compiled_kernel._entry("inverse", kinds)
    assert write_library(path, {entry: compiled.overloads[kinds.args]})
    function = load_library(path)["inverse"]
    assert function(np.array([0.0, 4.0]), 1) == 0.25
    with pytest.raises(ZeroDivisionError, match="inverse"):
        function(np.array([0.0, 4.0]), 0)


def test_the_library_is_loaded_without_numba(file):
    script = (
        "import sys; from pathlib import Path\n"
        "from dualfoot_ros.core.compiler.shared_library import load_library\n"
        f"found = load_library(Path({str(file)!r}))\n"
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
    assert load_library(path) is None


def test_arrays_of_another_kind_are_none_of_the_library(file, monkeypatch):
    monkeypatch.setattr(shared_library, "DATA", shared_library.DATA + 8)
    assert load_library(file) is None


def test_another_processor_has_another_library(tmp_path, monkeypatch):
    here = library_path(tmp_path)
    monkeypatch.setattr(shared_library, "_processor", lambda: "another one")
    assert library_path(tmp_path) != here


def test_where_it_cannot_be_linked_numba_is_asked_and_the_next_time_at_once(
    code, tmp_path, monkeypatch
):
    made = []
    monkeypatch.setattr(compiled_kernel, "_machine_code", lambda: made.append(1) or code)
    monkeypatch.setattr(shared_library, "LINKER", shutil.which("false"))
    assert compiled_kernel._from_library(tmp_path) is None
    assert compiled_kernel._from_library(tmp_path) is None
    assert made == [1]


def test_without_a_compiler_nothing_is_tried(tmp_path, monkeypatch):
    monkeypatch.setattr(compiled_kernel, "can_link", lambda: False)
    monkeypatch.setattr(compiled_kernel, "_machine_code", lambda: pytest.fail("compiled"))
    assert compiled_kernel._from_library(tmp_path) is None
    assert list(tmp_path.iterdir()) == []


def test_on_another_system_than_linux_nothing_is_tried(tmp_path, monkeypatch):
    monkeypatch.setattr(shared_library, "PROCESSOR", tmp_path / "none")
    monkeypatch.setattr(compiled_kernel, "_machine_code", lambda: pytest.fail("compiled"))
    assert compiled_kernel._from_library(tmp_path) is None
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_numba_is_asked(code, tmp_path, monkeypatch):
    monkeypatch.setattr(compiled_kernel, "_machine_code", lambda: code)
    assert compiled_kernel._from_library(tmp_path / "gone") is None


def test_every_entry_has_a_description_that_is_read_as_it_is_written():
    entries = [compiled_kernel._entry(*each) for each in compiled_kernel._signatures().items()]
    assert {entry.name for entry in entries} == set(ENTRIES)
    assert [Entry.read(str(entry)) for entry in entries] == entries
