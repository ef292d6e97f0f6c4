"""The two forms of the kernel: a live start waits for nothing, and nothing depends on numba."""

from __future__ import annotations

import hashlib
import importlib
import inspect
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from processes import PATIENCE_S

from dualfoot_ros.core import DualFootTracker
from dualfoot_ros.core.compiler import BackgroundEngine, background, cache_directory
from dualfoot_ros.core.compiler.entries import ENTRY_KINDS
from dualfoot_ros.core.compiler.made_library import can_compile
from dualfoot_ros.core.compiler.numba_cache import keep_in
from dualfoot_ros.core.compiler.same_bits import same_bits
from dualfoot_ros.core.kernel import (
    ENTRIES,
    MODULES,
    interpreted,
    kernel_functions,
    turn,
)
from dualfoot_ros.core.kernel.outputs import output_row

from ..following import live
from ..harness import walk

ROOT = Path(__file__).resolve().parents[3]
compiled_kernel = importlib.import_module("dualfoot_ros.core.compiler.compiled")

TRACK = """
import hashlib, json, sys
{before}
import numpy as np
from dualfoot_ros.core import DualFootTracker, ImuPair
data = np.load({file!r})
tracker = DualFootTracker()
first = tracker.add(ImuPair(int(data["stamps"][0]), data["values"][0]))
at_once = tracker.engine
digest, engines = hashlib.sha256(), []
for k in range(1, len(data["stamps"])):
    update = tracker.add(ImuPair(int(data["stamps"][k]), data["values"][k]))
    if update.row is not None:
        digest.update(update.row.tobytes())
    engines.append(tracker.engine)
    if k == 420 and tracker._stream.background is not None:
        tracker._stream.background.wait()
print(json.dumps([at_once, engines[300], engines[-1], digest.hexdigest()]))
"""


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """Return a walk that crosses a switch of the engine, as a file, and its interpreted digest."""
    pairs = walk(11.0)
    file = tmp_path_factory.mktemp("walk") / "pairs.npz"
    np.savez(file, stamps=pairs.stamps, values=pairs.values)
    rows = live(DualFootTracker(engine="interpreted"), pairs).rows
    return str(file), hashlib.sha256(b"".join(row.tobytes() for row in rows)).hexdigest()


def tracked(recording, before: str, cache: Path) -> list[str]:
    """Run the script in another process; return engine at once, midway, at the end, and digest."""
    script = TRACK.format(before=before, file=recording[0])
    environment = {**os.environ, "DUALFOOT_CACHE_DIR": str(cache), "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return json.loads(done.stdout)


NOTHING = 'sys.modules["numba"] = None'  # and the cache is empty, and "cc" is not found


def test_a_live_start_with_a_cold_cache_runs_interpreted_then_compiled_with_the_same_bits(
    recording, tmp_path
):
    """A compiler is enough: numba is asked only where there is none."""
    before = NOTHING if can_compile() else ""
    at_once, _, last, digest = tracked(recording, before, tmp_path)
    assert (at_once, last) == ("interpreted", "compiled")
    assert digest == recording[1]
    (directory,) = tmp_path.iterdir()
    assert (directory / "ready").exists()
    assert list(directory.rglob("*.so" if can_compile() else "*.nbi"))


def test_without_numba_and_compiler_everything_runs_interpreted_with_the_same_bits(
    recording, tmp_path
):
    nowhere = 'import os; os.environ["PATH"] = ""\n'
    engines_and_digest = tracked(recording, nowhere + NOTHING, tmp_path)
    assert engines_and_digest == ["interpreted", "interpreted", "interpreted", recording[1]]


@pytest.fixture
def nowhere(tmp_path, monkeypatch):
    """Let no cache be written."""
    blocked = tmp_path / "a file"
    blocked.write_text("no directory can be made below this")
    monkeypatch.setenv("DUALFOOT_CACHE_DIR", str(blocked / "cache"))


def test_where_no_cache_can_be_written_the_kernel_is_compiled_all_the_same(nowhere, monkeypatch):
    if not can_compile():
        pytest.skip("needs a C compiler (cc), on Linux")
    monkeypatch.setattr(compiled_kernel, "_from_numba", lambda _folder: pytest.fail("numba"))
    assert compiled_kernel.compiled.__wrapped__().name == "compiled"


def test_numba_has_the_bits_where_there_is_no_compiler(monkeypatch, tmp_path):
    """Two entries stand for all: the functions are the same for each."""
    pytest.importorskip("numba")
    few = ("set_flags", "closest", "turn")
    monkeypatch.setattr(compiled_kernel, "ENTRY_KINDS", {name: ENTRY_KINDS[name] for name in few})
    monkeypatch.setattr(compiled_kernel, "ENTRIES", few)
    made = compiled_kernel._from_numba(tmp_path)
    assert list(tmp_path.rglob("*.nbi"))
    assert same_bits({**interpreted()._asdict(), **made})


def test_numba_keeps_its_own_settings():
    """A change of its folder would send what others compile meanwhile to ours."""
    numba = pytest.importorskip("numba")
    before = numba.config.CACHE_DIR
    keep_in(numba.njit(_renamed), Path("nowhere"))
    assert before == numba.config.CACHE_DIR


def test_where_no_cache_can_be_written_no_other_process_is_asked_to_fill_it(nowhere, monkeypatch):
    pytest.importorskip("numba")
    engine, asked = interpreted(), []
    monkeypatch.setattr(background, "compiled", lambda: engine)
    monkeypatch.setattr(subprocess, "run", lambda *given, **how: asked.append(given))
    assert BackgroundEngine().wait() is engine
    assert asked == []


def test_no_two_functions_of_the_kernel_have_one_name():
    """All forms but the interpreted one know a function by its name alone."""
    names = [
        name
        for module in MODULES
        for name, item in vars(module).items()
        if inspect.isfunction(item) and item.__module__ == module.__name__
    ]
    assert sorted(names) == sorted(kernel_functions())


def test_importing_the_core_imports_neither_numba_nor_scipy():
    code = (
        "import sys, dualfoot_ros.core; "
        "print([m for m in ('numba', 'scipy', 'matplotlib', 'rosbags') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.strip() == "[]"


def test_the_cache_is_another_one_for_another_source_of_the_kernel(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALFOOT_CACHE_DIR", str(tmp_path))
    here = cache_directory()
    monkeypatch.setattr(output_row, "O_STANCE", output_row.O_STANCE + 1)
    moved = cache_directory()
    monkeypatch.setattr(turn, "symmetrise", other_source := _renamed(turn.turn_rows))
    assert other_source.__module__ == turn.__name__
    assert len({here, moved, cache_directory()}) == 3


def _renamed(function):
    """Return a kernel function under another's name, as an edit would put it there."""
    code = function.__code__.replace(co_name="symmetrise")
    renamed = type(function)(code, function.__globals__, "symmetrise")
    renamed.__module__ = function.__module__
    return renamed


def test_an_engine_has_every_entry():
    engine = interpreted()
    assert all(callable(getattr(engine, name)) for name in ENTRIES)
