"""The real walks with the defaults: what single-foot programs reach must be reached."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.evaluation import evaluate, track
from dualfoot_ros.recording.importers import ImportOptions, import_recording


def walks(folder: Path) -> list[Path]:
    """Return the recordings of a folder of the data set."""
    found = sorted(folder.glob("*.mat"))
    assert found, f"no recordings in {folder}"
    return found


def evaluated(path: Path, method: str = "zupt", **settings):
    """Return the evaluation of one recording, no parameter set but those of ``settings``."""
    return _evaluated(path, method=method, **settings)


@cache
def imported(path: Path):
    """Return one recording."""
    return import_recording(ImportOptions(sources=(path,)))


@cache
def _evaluated(path: Path, method: str, **settings):
    recording = imported(path)
    found = track(recording, TrackerConfig.from_mapping({"method": method, **settings}))
    return evaluate(found, reference=recording.reference)


@pytest.mark.parametrize("method", ["zupt", "idc"])
@pytest.mark.parametrize("folder", ["rectangle_ccw", "rectangle_cw"])
def test_the_right_foot_stands_once_on_every_marker_of_every_rectangle(dual_feet, folder, method):
    for path in walks(dual_feet / folder):
        errors = evaluated(path, method).marker_report["right"]
        assert (errors.stances, errors.markers) == (21, 21), path.name
        assert errors.rmse_m < 0.2, path.name


def test_plain_zupt_meets_the_markers_as_well_as_the_good_single_foot_programs(dual_feet):
    reports = [evaluated(p).marker_report["right"] for p in walks(dual_feet / "rectangle_ccw")]
    assert np.median([report.rmse_m for report in reports]) <= 0.13


def test_figures_of_eight_close_within_two_percent(dual_feet):
    for path in walks(dual_feet / "figure_eight"):
        assert evaluated(path).closure.mean_percent < 2.0, path.name


def test_both_laps_of_the_running_track_close_within_two_and_a_half_percent(dual_feet):
    for path in walks(dual_feet / "running_track"):
        found = evaluated(path)
        assert found.closure.mean_percent < 2.5, path.name
        assert found.trajectory.left.distance_m == pytest.approx(398.0, rel=0.03)


MAGNETIC = {"aids.magnetic_heading": True}


@pytest.mark.parametrize("method", ["zupt", "idc", "spacing_vector"])
def test_with_the_magnetic_heading_the_person_closes_both_laps_within_half_a_percent(
    dual_feet, method
):
    for path in walks(dual_feet / "running_track"):
        found = evaluated(path, method, **MAGNETIC)
        assert found.closure.midpoint_percent < 0.5, path.name
        events = found.trajectory.of_kind(EventKind.AID)
        assert np.mean([event.accepted for event in events]) > 0.95


def test_the_magnetic_heading_more_than_halves_how_far_single_feet_miss_the_end_of_a_lap(
    dual_feet,
):
    for path in walks(dual_feet / "running_track"):
        plain, found = evaluated(path), evaluated(path, **MAGNETIC)
        assert found.closure.mean_percent < 0.5 * plain.closure.mean_percent, path.name


def test_indoors_the_magnetic_heading_finds_no_field_to_hold_on_to_and_changes_nothing(dual_feet):
    paths = [*walks(dual_feet / "rectangle_cw"), *walks(dual_feet / "figure_eight")]
    for path in paths:
        plain, found = evaluated(path).trajectory, evaluated(path, **MAGNETIC).trajectory
        assert np.abs(found.left.position - plain.left.position).max() < 0.05, path.name
        assert np.abs(found.right.position - plain.right.position).max() < 0.05, path.name


@pytest.mark.parametrize("method", ["zupt", "spacing_vector"])
def test_both_laps_end_within_two_and_a_half_of_the_sigma_that_they_promise(dual_feet, method):
    for path in walks(dual_feet / "running_track"):
        run = evaluated(path, method).trajectory
        for foot in (run.left, run.right):
            missed = foot.position[-1] - foot.position[0]
            sigma = np.sqrt(np.diag(foot.position_covariance[-1]))
            assert (np.abs(missed) < 2.5 * sigma).all(), (path.name, missed, sigma)
            assert sigma[2] < 3.0 and sigma[:2].max() < 20.0, path.name
