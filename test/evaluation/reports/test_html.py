"""The pages of reports as text: words first, self-contained, and true to the figures."""

import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from dualfoot_ros.evaluation import evaluate
from dualfoot_ros.evaluation.exports import GeoOrigin
from dualfoot_ros.evaluation.reports.html.comparison_page import comparison_page
from dualfoot_ros.evaluation.reports.html.page import script_data
from dualfoot_ros.evaluation.reports.html.page_tables import column, thin
from dualfoot_ros.evaluation.reports.html.walk_page import walk_page
from dualfoot_ros.evaluation.reports.html.words import Tone, _symmetry, clock, in_words
from dualfoot_ros.evaluation.reports.plots import draw_all
from dualfoot_ros.evaluation.tracked_person import person_track
from dualfoot_ros.inspection import Finding, FindingKind, Severity
from dualfoot_ros.recording.reference import Reference

from ..walks import perfect, rectangle
from .entries import entries_of, rows_of


def decoded(made):
    """Return the values of a column, as the script of the page reads them."""
    total, values = 0, []
    for step in made["d"]:
        if step is None:
            values.append(np.nan)
            continue
        total += step
        values.append(total * made["unit"])
    return np.array(values)


def data_of(page):
    text = re.search(r'id="data">(.*?)</script>', page, re.S)[1]
    return json.loads(text)


def test_a_column_is_exact_to_its_unit_and_keeps_its_holes():
    values = np.array([1.2345, np.nan, -7.0, 1e6, np.inf, 0.0004])
    found = decoded(column(values))
    assert np.isnan(found[[1, 4]]).all()
    known = [0, 2, 3, 5]
    assert found[known] == pytest.approx(values[known], abs=0.00051)


@pytest.mark.parametrize(("count", "most"), [(1, 10), (10, 10), (100_001, 8000)])
def test_thinning_keeps_both_ends_and_the_limit(count, most):
    rows = thin(count, most)
    assert rows[0] == 0 and rows[-1] == count - 1
    assert len(rows) <= most


def test_the_page_needs_nothing_from_elsewhere():
    track, truth = perfect(rectangle())
    page = walk_page({"zupt": evaluate(track, truth=truth)}, "a walk")
    assert re.findall(r'(?:src|href)="(?!data:)[^"]*"', page) == []
    assert "default-src 'none'" in page
    assert "http" not in page.replace("http-equiv", "").replace("http://www.w3.org/2000/svg", "")


def test_a_date_is_given_only_where_the_stamps_tell_one():
    track, _ = perfect()
    assert "Walk of 2023-11-14" in walk_page({"zupt": evaluate(track)}, "a walk")
    for foot in (track.left, track.right):
        foot.stamp_ns[:] -= 1_700_000_000_000_000_000
    young = replace(track, start_ns=int(track.left.stamp_ns[0]))
    assert "clock of the sensors" in walk_page({"zupt": evaluate(young)}, "a walk")


def test_names_cannot_become_markup():
    track, _ = perfect()
    title = "</script><script>alert(1)</script>"
    page = walk_page({"zupt": evaluate(track)}, title, {"<b>": "&"})
    assert "<script>alert" not in page
    assert "</script" not in script_data({"a": title})
    assert json.loads(script_data({"a": title})) == {"a": title}


def test_every_plot_names_columns_that_are_there():
    track, truth = perfect(rectangle())
    data = data_of(walk_page({"a": evaluate(track, truth=truth), "b": evaluate(track)}, "a walk"))
    assert len(data["charts"]) == 16
    for chart in data["charts"].values():
        for series in chart["series"]:
            columns = data["tables"][series["table"]]
            names = [series[key] for key in ("x", "y", "end", "half") if series.get(key)]
            assert set(names) <= set(columns)
        known = data["tables"][chart["link"]]
        assert {key for key, _, _ in chart["told"]} <= set(known)


def test_the_words_name_distance_and_error_and_warn_in_front():
    track, truth = perfect(rectangle())
    run = evaluate(track, truth=truth)
    warned = replace(
        run, findings=(Finding(FindingKind.EXCHANGED_FEET, Severity.WARNING, "Odd", "look"),)
    )
    sentences = in_words(warned, person_track(run.trajectory))
    assert sentences[0].tone is Tone.WARNING and sentences[0].text == "Odd; look."
    walked = f"{person_track(run.trajectory).walked_m[-1]:.1f} m"
    assert any(walked in s.text for s in sentences)
    assert any("0.00 m off at the end" in s.text for s in sentences)
    good = in_words(replace(run, run_s=1.0), person_track(run.trajectory))
    assert good[0].tone is Tone.GOOD
    unchecked = in_words(run, person_track(run.trajectory))
    assert {s.tone for s in unchecked} == {Tone.PLAIN}


def test_a_closed_loop_is_called_so_only_where_it_is_known():
    track, _ = perfect(rectangle())
    loop = evaluate(track, reference=Reference("tape", {}, closed_loop=True))
    known = " ".join(s.text for s in in_words(loop, person_track(track)))
    unknown = " ".join(s.text for s in in_words(evaluate(track), person_track(track)))
    assert "The walk is a loop" in known
    assert "if the walk was a loop" in unknown


def test_the_person_is_midway_with_the_covariance_of_the_mean_of_both_feet():
    track, _ = perfect(rectangle())
    person = person_track(track)
    middle = (track.left.position + track.right.position) / 2
    assert person.position == pytest.approx(middle)
    # independent feet of 0.1 m each: the mean has 0.1 / sqrt(2)
    assert person.covariance[5] == pytest.approx(np.eye(3) * 0.005)
    unknown = replace(track, relative_covariance=np.full_like(track.relative_covariance, np.nan))
    assert person_track(unknown).covariance[5] == pytest.approx(np.eye(3) * 0.01)


def test_the_person_faces_along_the_way():
    track, _ = perfect(rectangle())
    heading = person_track(track).heading
    assert heading[0] == pytest.approx(np.pi / 2, abs=0.1)
    assert heading[-1] - heading[0] == pytest.approx(1.5 * np.pi, abs=0.3)


def test_a_comparison_names_the_best_and_every_failure():
    entries = entries_of()
    rows = rows_of(entries)
    for row in rows:
        row["midpoint_rmse_m"] = 0.5 if row["case"] == "zupt" else 0.2
    page = comparison_page(entries, rows, {"far, zupt": "there are no samples"})
    assert "idc has the smallest error against the truth (RMSE): 0.20 m" in page
    assert "zupt has the largest: 0.50 m" in page
    assert "far, zupt gave no figures: there are no samples." in page
    assert len(data_of(page)["charts"]) == 2


def test_a_comparison_calls_no_method_best_where_the_figures_read_the_same():
    entries = entries_of()
    rows = rows_of(entries)
    for row in rows:
        row["midpoint_rmse_m"] = 0.293 if row["case"] == "zupt" else 0.291
    page = comparison_page(entries, rows, {})
    assert "All 2 have the same error against the truth (RMSE): 0.29 m." in page
    assert "smallest" not in page


def test_a_comparison_shows_baseline_best_worst_and_default_at_first():
    names = ("max_distance", "zupt", "idc", "min_distance", "step_length", "spacing_vector")
    first = entries_of()[0]
    entries = [replace(first, case=replace(first.case, label=name)) for name in names]
    rows = rows_of(entries)
    for row, error in zip(rows, (0.3, 0.35, 0.2, 0.5, 0.4, 0.25), strict=True):
        row["midpoint_rmse_m"] = error
        row["feet_crossed_percent"] = 100 * error if error > 0.35 else 0.0
    page = comparison_page(entries, rows, {})
    assert "spacing_vector, the default, has 0.25 m" in page
    assert "wrong side" in page and "min_distance (50 %), step_length (40 %)" in page
    tracks = {s["name"]: s for s in data_of(page)["charts"]["map0"]["series"] if "shown" in s}
    shown = {name for name, series in tracks.items() if series["shown"]}
    assert shown == {"zupt", "min_distance", "idc", "spacing_vector"}
    widths = [series["width"] for series in tracks.values()]
    assert widths == sorted(widths, reverse=True)


def test_figures_that_some_recordings_lack_say_in_how_many_they_are_known():
    entries = entries_of()
    rows = rows_of(entries)
    for row in rows:
        row["midpoint_rmse_m"] = 0.5 if row["bag"] == "one" else None
    assert "(1 of 2 recordings have this figure)" in comparison_page(entries, rows, {})


def test_the_words_tell_the_horizontal_error_beside_the_claim_and_call_equal_feet_equal():
    track, truth = perfect(rectangle())
    for foot in (track.left, track.right):
        foot.position[:, 2] += np.linspace(0.0, 0.4, len(foot))
    run = evaluate(track, truth=truth)
    said = " ".join(s.text for s in in_words(run, person_track(run.trajectory)))
    assert "0.00 m horizontally" in said and "Horizontally, the filter claims" in said
    assert f"{run.truth_report.midpoint.rmse_vertical_m:.2f} m in height" in said
    assert _symmetry(0.01) == "both feet stand equally long"
    assert "right foot is 0.1 % longer" in _symmetry(0.06)


def test_a_long_walk_hides_the_lines_that_would_fill_the_plot_and_keeps_the_moments():
    points = np.column_stack([np.arange(400) * 1.2, np.zeros(400)])
    track, truth = perfect(points)
    page = walk_page({"a": evaluate(track, truth=truth)}, "a walk")
    apart = data_of(page)["charts"]["0.apart"]["series"]
    assert [s.get("shown", True) for s in apart] == [False, True, False, True]


def test_a_report_of_one_foot_speaks_and_draws_of_that_foot_alone(tmp_path):
    track, _ = perfect(rectangle())
    track.right.present[:] = False
    for values in (track.right.position, track.right.stance):
        values[:] = 0
    run = evaluate(track)
    page = walk_page({"zupt": run}, "a walk")
    assert "strides of the left foot alone" in page
    charts = data_of(page)["charts"]
    assert "0.apart" not in charts and len(charts) == 7
    names = {series["name"] for chart in charts.values() for series in chart["series"]}
    assert "left foot" in names and not any("right" in name for name in names)
    paths = draw_all({"zupt": run}, tmp_path, "a walk")
    assert [path.stem for path in paths] == ["tracks", "stances"]


@pytest.mark.parametrize(("bearing", "north"), [(None, 90.0), (90.0, 180.0), (0.0, 90.0)])
def test_north_is_where_the_bearing_of_the_first_metres_puts_it(bearing, north):
    track, _ = perfect(rectangle())  # it starts along y
    origin = GeoOrigin(48.0, 11.0, bearing)
    data = data_of(walk_page({"zupt": evaluate(track)}, "a walk", origin=origin))
    assert data["charts"]["0.map"]["north"] == pytest.approx(north, abs=1.0)


@pytest.mark.parametrize(
    ("seconds", "words"), [(57, "57 s"), (680, "11:20 min"), (4460, "1:14:20 h")]
)
def test_the_time_of_a_tile_is_short(seconds, words):
    stamps = np.array([10**18, 10**18 + seconds * 10**9])
    assert clock(SimpleNamespace(stamp_ns=stamps)) == words
