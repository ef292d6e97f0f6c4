"""Walks whose arrays are in files: every figure and every byte is that of a walk in memory."""

import numpy as np
import pytest

from dualfoot_ros.core import make_large_arrays_in
from dualfoot_ros.core.samples import large_arrays
from dualfoot_ros.evaluation import RunOptions, run
from dualfoot_ros.evaluation.reports import write_tracks
from dualfoot_ros.recording import Recording, keep_large_arrays_on_disk
from dualfoot_ros.simulation import WalkConfig, simulate


@pytest.fixture(scope="module")
def walked() -> Recording:
    """Return a simulated walk with truth."""
    made = simulate(WalkConfig(route="rectangle", rate=60.0, standing=4.0), seed=4)
    return Recording(made.left, made.right, made.left_truth, made.right_truth)


def test_a_walk_in_files_has_the_figures_and_the_text_of_one_in_memory(
    walked, tmp_path, monkeypatch
):
    options = RunOptions(all_covariances=False)
    results = [run(walked, options=options)]
    monkeypatch.setattr(large_arrays, "LARGE", 1 << 10)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    keep_large_arrays_on_disk()
    try:
        results.append(run(walked, options=options))
    finally:
        make_large_arrays_in(None)
    memory, files = results
    assert files.to_dict() == memory.to_dict()
    assert np.array_equal(files.person.radius_95_m, memory.person.radius_95_m)
    texts = []
    for name, result in zip(("memory", "files"), results, strict=True):
        folder = tmp_path / name
        folder.mkdir()
        texts.append([path.read_bytes() for path in write_tracks(folder, result)])
    assert texts[0] == texts[1]
