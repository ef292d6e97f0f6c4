"""Tables, figures, TUM files and folders of a report."""

import io
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from dualfoot_ros.evaluation import Align, EvaluationError, Options, demo_report, evaluate
from dualfoot_ros.evaluation.notes import marker_notes, refusal_notes
from dualfoot_ros.evaluation.plain import plain
from dualfoot_ros.evaluation.reports.output import check_directory, report_folder
from dualfoot_ros.evaluation.reports.plots import draw_all, stances, tracks
from dualfoot_ros.evaluation.reports.plots.distance import draw_distance
from dualfoot_ros.evaluation.reports.plots.error_curves import _in_stance
from dualfoot_ros.evaluation.reports.text_files import write_tracks
from dualfoot_ros.evaluation.reports.walk_table import _few, walk_table
from dualfoot_ros.recording.recording import Recording
from dualfoot_ros.recording.reference import Reference

from ..walks import along, foot, perfect, rectangle, straight, trajectory

PNG = b"\x89PNG\r\n\x1a\n"
BESIDE = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
EVO = shutil.which("evo_ape", path=BESIDE)


def shown(table) -> str:
    """Return a table as text without line breaks inside cells."""
    console = Console(width=200, record=True, file=io.StringIO())
    console.print(table)
    return console.export_text()


def drifted(seed: int = 1):
    """Return a walk whose estimate strays by a random walk, with its truth."""
    track, truth = perfect(rectangle())
    rng = np.random.default_rng(seed)
    for side in (track.left, track.right):
        side.position[:] += np.cumsum(rng.normal(scale=0.004, size=side.position.shape), axis=0)
    return track, truth


def test_the_table_of_a_walk_shows_the_figures_and_names_the_alignment():
    track, truth = drifted()
    found = evaluate(track, truth=truth, options=Options(Align.UMEYAMA4))
    text = shown(walk_table(found, "a walk"))
    assert f"{found.truth_report.left.rmse_m:.3f}" in text
    assert f"{found.truth_report.heading.difference_end_deg:.2f} difference" in text
    assert "umeyama4" in text
    assert "marker" not in text


def test_the_table_without_any_reference_shows_only_what_the_feet_tell():
    text = shown(walk_table(evaluate(drifted()[0]), "a walk"))
    assert "none (no reference)" in text
    assert "start to end" in text
    assert "RMSE (m)" not in text.replace("RMS, max (m)", "")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Return the figures of a walk, and whether drawing them has imported pyplot.

    No legend can search for its place meanwhile.
    """
    from matplotlib.legend import Legend

    def search(*_):
        raise AssertionError

    track, truth = drifted()
    sys.modules.pop("matplotlib.pyplot", None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Legend, "_find_best_position", search)
        folder = tmp_path_factory.mktemp("report")
        paths = draw_all({"zupt": evaluate(track, truth=truth)}, folder, "a walk")
    return SimpleNamespace(paths=paths, with_pyplot="matplotlib.pyplot" in sys.modules)


def test_every_figure_of_the_report_is_drawn_as_a_png(drawn):
    assert [p.stem for p in drawn.paths] == ["tracks", "feet_distance", "stances", "errors"]
    assert all(p.read_bytes().startswith(PNG) for p in drawn.paths)


def test_drawing_leaves_no_global_state_of_pyplot(drawn):
    assert not drawn.with_pyplot


def test_no_legend_searches_for_its_place(drawn):
    assert drawn.paths and all(path.stat().st_size > 0 for path in drawn.paths)


def test_markers_have_a_figure_and_a_walk_of_many_stances_is_drawn_too(tmp_path):
    count = tracks.MOST_DOTS + 1
    points = np.column_stack([np.arange(count) * 1.2, np.zeros(count)])
    track, _ = perfect(points)
    side = points + np.array([0.0, -0.1])
    markers = Reference("made by formula", {"right": np.column_stack([side, np.zeros(count)])})
    paths = draw_all({"zupt": evaluate(track, reference=markers)}, tmp_path, "a walk")
    assert paths[-1].name == "marker_errors.png"


def test_the_legend_of_a_narrow_walk_is_not_cut_off(tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(tracks, "save", lambda figure, path: drawn.append(figure))
    points = np.column_stack([np.zeros(40), np.arange(40) * 1.2])
    track, _ = perfect(points)
    side = points + np.array([0.1, 0.0])
    markers = Reference("made by formula", {"right": np.column_stack([side, np.zeros(40)])})
    tracks.draw_tracks({"zupt": evaluate(track, reference=markers)}, tmp_path / "x", "a walk")
    (figure,) = drawn
    figure.draw_without_rendering()
    (legend,) = figure.legends
    extent = legend.get_window_extent()
    assert len(legend.texts) == 5
    assert extent.x0 >= 0.0
    assert extent.x1 <= figure.bbox.width


def test_constraints_applied_and_refused_are_told_apart_in_counts_and_drawn(tmp_path):
    left, right, stance = straight()
    feet = foot(left, stance[0]), foot(right, stance[1])
    found = evaluate(trajectory(*feet, moments=left.stamp_ns[100:400:60]))
    assert found.to_dict()["events"] == {"constraint": {"applied": 5}}
    assert found.feet.moments == "constraint"
    assert draw_distance({"idc": found}, tmp_path / "distance.png", "a walk").stat().st_size > 0
    assert stances.draw_stances(found, tmp_path / "stances.png", "a walk").stat().st_size > 0


def test_a_demonstration_has_one_table_with_a_block_a_method_and_files_on_disk(tmp_path):
    track, truth = drifted()
    recording = Recording(left_truth=truth[0], right_truth=truth[1])
    runs = {"zupt": track, "idc": drifted(2)[0]}
    report = demo_report(runs, recording, tmp_path / "demo")
    text = shown(report.table())
    for name, run in report.runs.items():
        assert name in text
        for errors in (run.truth_report.left, run.truth_report.right):
            assert f"{errors.rmse_m:.3f}" in text
            assert f"{errors.end_percent:.2f}" in text
    assert all(path.is_file() for path in report.paths)
    saved = json.loads((tmp_path / "demo" / "metrics.json").read_text())
    assert set(saved["runs"]) == {"zupt", "idc"}


def test_a_demonstration_without_truth_is_refused_and_writes_nothing(tmp_path):
    with pytest.raises(EvaluationError, match="truth"):
        demo_report({"zupt": drifted()[0]}, Recording(), tmp_path / "demo")
    assert list(tmp_path.iterdir()) == []


def test_a_report_that_fails_half_way_leaves_the_folder_as_it_was(tmp_path):
    target = tmp_path / "report"
    target.mkdir()
    (target / "metrics.json").write_text("old")

    def fail():
        with report_folder(target) as folder:
            (folder / "metrics.json").write_text("new")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert (target / "metrics.json").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["report"]


def test_a_new_report_replaces_the_old_one_and_nothing_else_in_the_folder(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "errors.png").write_text("old")
    with report_folder(tmp_path) as folder:
        (folder / "metrics.json").write_text("new")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["metrics.json", "notes.txt"]


@pytest.mark.parametrize("kilometres", [0.5, 1.0, 4.4])
def test_a_long_walk_has_at_most_five_rows_of_errors_along_the_way(kilometres):
    marks = [f"{mark:g}" for mark in np.arange(200.0, 1000.0 * kilometres + 1, 200.0)]
    shown = _few(marks)
    assert 1 <= len(shown) <= 5
    steps = np.diff([float(mark) for mark in shown])
    assert np.ptp(steps) == 0 if len(steps) else True
    assert _few([]) == []


def test_the_stances_of_an_hour_are_drawn_line_by_line_without_an_end():
    assert stances._row_s(200.0) == 20.0
    assert stances._row_s(931.0) * stances.MOST_ROWS >= 931.0
    assert stances._row_s(3600.0) == stances.LONGEST_ROW_S


def test_an_earlier_report_is_replaced_only_when_that_is_asked_for(tmp_path):
    check_directory(tmp_path / "new")
    (tmp_path / "notes.txt").write_text("mine")
    check_directory(tmp_path)
    (tmp_path / "metrics.json").write_text("{}")
    with pytest.raises(EvaluationError, match="--overwrite"):
        check_directory(tmp_path)
    check_directory(tmp_path, overwrite=True)


@pytest.mark.parametrize("inside", [".", "report", "reports/of/today"])
def test_a_report_never_goes_into_a_recording_not_even_when_asked(tmp_path, inside):
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information:\n  version: 9\n")
    with pytest.raises(EvaluationError, match="outside"):
        check_directory(tmp_path / inside, overwrite=True)
    with pytest.raises(EvaluationError, match="outside"), report_folder(tmp_path / inside):
        pass
    assert [p.name for p in tmp_path.iterdir()] == ["metadata.yaml"]


def test_plain_values_have_no_arrays_no_enums_and_no_not_a_number():
    value = {"a": np.array([1.0, np.nan]), "b": np.float64(2.0), "c": (Align.UMEYAMA4, np.inf)}
    assert plain(value) == {"a": [1.0, None], "b": 2.0, "c": ["umeyama4", None]}


def test_refusals_become_sentences_and_silence_stays_silent():
    counters = {"pairs": 900, "sync.left_not_finite": 3, "duplicate": 0, "gaps": 1}
    assert list(refusal_notes(counters)) == [
        "3 samples of the left foot left out: values that are not finite",
        "1 gap in the samples",
    ]


def test_a_missed_stance_is_said_in_words():
    track, _ = perfect(rectangle())
    found = evaluate(track, reference=Reference("", {"right": np.eye(3) * 3}))
    assert "21 stances of the right foot for 3 markers" in found.notes[0]
    assert list(marker_notes({})) == []


@pytest.mark.skipif(EVO is None, reason="evo is not installed (pip install evo)")
@pytest.mark.parametrize("align", list(Align))
def test_evo_reads_the_tum_files_and_finds_the_same_ate(align, tmp_path):
    track, truth = drifted()
    found = evaluate(track, truth=truth, options=Options(align))
    write_tracks(tmp_path, found)
    for name, errors in (("left", found.truth_report.left), ("right", found.truth_report.right)):
        files = [str(tmp_path / f"{name}_truth.tum"), str(tmp_path / f"{name}.tum")]
        command = [EVO, "tum", *files, "-r", "trans_part"]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        figures = dict(line.split() for line in text.splitlines() if len(line.split()) == 2)
        assert float(figures["rmse"]) == pytest.approx(errors.rmse_m, abs=1e-6)
        assert float(figures["max"]) == pytest.approx(errors.max_m, abs=1e-6)


def test_feet_of_the_walk_made_by_formula_stand_where_they_are_said_to():
    left, right, stance = along(rectangle())
    for truth, stands in ((left, stance[0]), (right, stance[1])):
        moved = np.linalg.norm(np.diff(truth.position, axis=0), axis=1)
        assert moved[stands[1:] & stands[:-1]].max() == 0.0


def test_a_heading_error_in_the_swing_is_drawn_as_the_line_from_stance_to_stance():
    stance = np.array([False, True, True, False, False, True])
    found = _in_stance(np.array([9.0, 1.0, 2.0, 70.0, -70.0, 5.0]), stance)
    assert found.tolist() == [1.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    never = np.array([1.0, 2.0])
    assert _in_stance(never, np.zeros(2, dtype=bool)).tolist() == never.tolist()
