"""The report of a demonstration: tracks of several methods on one recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...core import EvaluationError, Trajectory
from ...recording import Recording
from ..frames.gauge import Options
from ..track import truth_of
from ..whole_evaluation import Evaluation, evaluate
from .html import write_walk_page
from .output import METRICS, report_folder, write_json
from .plots import draw_all
from .text_files import write_tracks
from .walk_table import methods_table

if TYPE_CHECKING:
    from rich.table import Table


@dataclass(frozen=True)
class Report:
    """The evaluations by method, and the files that were written."""

    title: str
    runs: dict[str, Evaluation]
    paths: tuple[Path, ...]

    def table(self) -> Table:
        """Return the one table: RMSE, end error, headings and crossings, a block a method."""
        return methods_table(self.runs, self.title)

    def to_dict(self) -> dict[str, Any]:
        """Return all figures as plain values."""
        return {
            "title": self.title,
            "runs": {name: run.to_dict() for name, run in self.runs.items()},
            "files": [str(path) for path in self.paths],
        }


def demo_report(
    runs: Mapping[str, Trajectory],
    recording: Recording,
    out_dir: str | Path,
    *,
    title: str = "demo",
    options: Options | None = None,
) -> Report:
    """Evaluate trajectories of the same recording against its truth; write figures and files.

    Parameters
    ----------
    runs : name of the method -> its trajectory, live or offline
    recording : with the truth of both feet
    out_dir : folder of the report

    Raises
    ------
    EvaluationError
        When there is no run, or the recording has no truth.
    """
    truth = truth_of(recording)
    if not runs:
        raise EvaluationError("no trajectory to report on")
    if truth is None:
        raise EvaluationError("the recording has no truth of both feet to compare with")
    evaluations = {
        name: evaluate(run, truth=truth, reference=recording.reference, options=options)
        for name, run in runs.items()
    }
    target = Path(out_dir)
    with report_folder(target) as folder:
        figures = draw_all(evaluations, folder, title)
        tracks = [
            p for name, run in evaluations.items() for p in write_tracks(folder, run, f"{name}_")
        ]
        written = (*figures, *tracks)
        best_first = dict(reversed(evaluations.items()))  # the demonstration ends with the default
        page = write_walk_page(folder, best_first, title)
        paths = tuple(target / path.name for path in (*written, folder / METRICS, page))
        report = Report(title, evaluations, paths)
        write_json(folder / METRICS, report.to_dict())
    return report
