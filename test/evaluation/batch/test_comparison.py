"""What a run is reduced to for comparison, and the tables of many."""

from __future__ import annotations

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from dualfoot_ros.core import TrackerConfig
from dualfoot_ros.evaluation import evaluate
from dualfoot_ros.evaluation.batch.cases import Case
from dualfoot_ros.evaluation.batch.comparison import (
    Entry,
    Job,
    _distance_errors,
    _tracks,
    by_bag,
    least_distances,
    thinned,
)
from dualfoot_ros.evaluation.frames.gauge import Options
from dualfoot_ros.evaluation.reports.comparison_rows import by_case, csv_text, flat, over_bags
from dualfoot_ros.evaluation.reports.comparison_tables import tables

from ..walks import SPACING, perfect


def walked(strides: int = 200, sideways: float = 0.0):
    """Return the evaluation of a straight walk whose right foot is ``sideways`` m too far left."""
    points = np.column_stack([np.arange(strides + 1) * 1.2, np.zeros(strides + 1)])
    run, truth = perfect(points)
    shifted = run.right.position + np.array([0.0, sideways, 0.0])
    run = replace(run, right=replace(run.right, position=shifted))
    return evaluate(run, truth=truth)


def entry(found, label: str = "zupt", bag: str = "walk", swept=None) -> Entry:
    case = Case(label, TrackerConfig(method="zupt"), swept)
    return Entry(bag, case, found.to_dict(), _distance_errors(found), None, 0.5, _tracks(found))


def jobs_on(bags: int, cases: int) -> list[Job]:
    """Return jobs of so many cases on each of so many bags."""
    names = [(f"bag{bag}", f"case{case}") for bag in range(bags) for case in range(cases)]
    return [Job(bag, Case(case, TrackerConfig()), Options()) for bag, case in names]


@pytest.mark.parametrize(
    ("bags", "processes", "sizes"),
    [
        (8, 1, [11] * 8),
        (8, 2, [11, 11, 11, 11, 11, 11, 6, 6, 3, 3, 1, 1, 1, 1]),
        (3, 2, [11, 6, 6, 3, 3, 1, 1, 1, 1]),
        (1, 2, [3, 2, 2, 1, 1, 1, 1]),
        (1, 16, [1] * 11),
        (0, 2, []),
    ],
)
def test_bags_are_done_whole_but_for_the_last_one_of_each_process(bags, processes, sizes):
    jobs = jobs_on(bags, 11)
    groups = by_bag(jobs, processes)
    assert [len(group) for group in groups] == sizes
    assert sorted(pair for group in groups for pair in group) == list(enumerate(jobs))
    assert all(len({job.bag for _, job in group}) == 1 for group in groups)


def test_the_true_moments_of_least_distance_are_found_once_a_passing():
    found = walked(strides=20)
    at = least_distances(found.truth, found.trajectory.left.stance, found.trajectory.right.stance)
    apart = np.linalg.norm(found.truth[0].position - found.truth[1].position, axis=1)[at]
    assert len(at) == 20 + 21  # the left foot begins and ends with half a stride
    assert apart == pytest.approx(SPACING, abs=0.02)


@pytest.mark.parametrize("sideways", (0.05, -0.08))
def test_table_ii_is_the_error_of_the_distance_at_those_moments(sideways):
    """The frame is aligned to both feet, so the feet stay apart by what they are apart."""
    spread = _distance_errors(walked(strides=20, sideways=sideways))
    assert spread.mean == pytest.approx(-sideways, abs=0.005)
    assert spread.rms >= abs(spread.mean)
    assert spread.std < 0.01


def test_a_row_has_the_errors_at_every_200_m_by_foot():
    row = flat(entry(walked(strides=400)))
    assert {name for name in row if "_error_at_" in name} == {
        f"{foot}_error_at_{mark}_m" for foot in ("left", "right") for mark in (200, 400)
    }
    assert row["left_end_m"] == pytest.approx(0.0, abs=1e-9)
    assert row["run_s"] == 0.5


def test_an_open_walk_has_no_closure():
    assert flat(entry(walked(strides=10)))["closure_mean_m"] is None


def test_rows_of_any_shape_make_one_csv():
    rows = [{"bag": "a", "case": "x", "one": 1.5}, {"bag": "b", "case": "x", "two": None}]
    read = list(csv.DictReader(io.StringIO(csv_text(rows))))
    assert [row["one"] for row in read] == ["1.5", ""]
    assert set(read[0]) == {"bag", "case", "one", "two"}


def test_over_the_bags_a_missing_figure_does_not_count():
    rows = [{"case": "x", "v": 1.0}, {"case": "x", "v": None}, {"case": "x", "v": 3.0}]
    assert over_bags(rows, "v") == 2.0
    assert over_bags(rows, "v", max) == 3.0
    assert over_bags(rows, "w") is None
    assert list(by_case(rows)) == ["x"]


def test_tracks_keep_their_last_point_when_thinned():
    position = np.random.default_rng(0).normal(size=(5000, 3))
    few = thinned(position)
    assert len(few) <= 1500
    assert np.array_equal(few[-1], position[-1, :2]) and np.array_equal(few[0], position[0, :2])


def shown(rows) -> str:
    from rich.console import Console

    console = Console(width=160, record=True, file=io.StringIO())
    for table in tables(rows):
        console.print(table)
    return console.export_text()


def test_the_tables_name_what_the_papers_print():
    rows = [flat(entry(walked(strides=200)))]
    text = shown(rows)
    for words in ("Table III", "200 m", "Table II", "RMS", "MAX", "run time", "crossed"):
        assert words in text
    assert "Table I " not in text and "68" not in text


def test_a_sweep_has_tables_of_its_own():
    plain = flat(entry(walked(strides=20)))
    swept = [flat(entry(walked(20), f"zupt gamma={v}", swept=("gamma", v))) for v in (1.0, 2.0)]
    text = shown([plain, *swept])
    assert "gamma swept" in text
    assert text.count("zupt gamma=1.0") == 1


def test_figures_of_many_bags_are_median_and_worst():
    rows = [flat(entry(walked(20, sideways=s), bag=f"{s}")) for s in (0.0, 0.02, 0.2)]
    text = shown(rows)
    assert "3 bags; median (worst)" in text
