"""The registry of methods: this package's, and those that other packages bring."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from dualfoot_ros.core import ConfigError, TrackerConfig
from dualfoot_ros.core.constraints import ENTRY_POINTS, METHODS, Method
from dualfoot_ros.core.constraints.method_registry import checked
from dualfoot_ros.recording import Recording, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate

ROOT = Path(__file__).resolve().parents[3]
HEIGHT = '''"""``same_height``: both feet are as high at the end of a stance."""

from dataclasses import dataclass

import numpy as np

from dualfoot_ros.core import Parameters, parameter
from dualfoot_ros.core.constraints import Details, Method, Outcome, Request, position_row


@dataclass(frozen=True)
class SameHeightConfig(Parameters):
    """Parameters of the method."""

    height_std: float = parameter(0.1, "unevenness", unit="m", minimum=1e-3, maximum=1.0)


class SameHeight(Method):
    """Observes the difference in height, and for the sake of the test the lateral one."""

    name = "same_height"
    config_class = SameHeightConfig
    dimensions = 2

    def on_stance_end(self, stance, gait):
        """Ask for it now."""
        return (Request(gait.now, False, self.apply),)

    def apply(self, estimate):
        """Update with two rows."""
        rows = [{position_row(0, 2): 1.0, position_row(1, 2): -1.0}, {position_row(0, 1): 1.0}]
        innovation = [estimate.relative_position()[2], 0.0]
        variances = [self.config.height_std**2, 1e6]
        s, nis = estimate.update(rows, innovation, variances)
        return Outcome(np.array(innovation), s, nis, True, Details({"what": "height"}))
'''
USE = """
import json, sys
from dualfoot_ros.core import DualFootTracker, EventKind, TrackerConfig, all_specs
from dualfoot_ros.evaluation.batch.monte_carlo import constraint_dimensions
from dualfoot_ros.simulation import WalkConfig, simulate
config = TrackerConfig.from_mapping({"method": "same_height", "same_height.height_std": 0.2})
made = simulate(WalkConfig.from_mapping({"route": "L", "standing": 4.0, "rate": 60.0}), seed=1)
result = DualFootTracker(config, engine="interpreted" if "numba" not in sys.modules else "auto")
track = result.run(made.left[:840], made.right[:840])
events = track.of_kind(EventKind.CONSTRAINT)
print(json.dumps({
    "specs": [s.name for s in all_specs() if s.name.startswith("same_height")],
    "events": len(events),
    "detail": events[0].detail,
    "dimensions": constraint_dimensions(config),
    "mapping": config.to_mapping()["same_height.height_std"],
}))
"""


def package(folder: Path, module: str, text: str, points: dict[str, str]) -> None:
    """Put an installed package into ``folder``: one module, and its entry points."""
    (folder / f"{module}.py").write_text(text)
    info = folder / f"{module}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1.0\n")
    lines = "\n".join(f"{name} = {value}" for name, value in points.items())
    (info / "entry_points.txt").write_text(f"[{ENTRY_POINTS}]\n{lines}\n")


def run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run Python with the packages in ``folder``."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])}
    return subprocess.run(
        [sys.executable, *command], env=environment, check=False, capture_output=True, text=True
    )


@pytest.fixture
def brought(tmp_path):
    """Return a folder with a package that brings the method ``same_height``."""
    package(tmp_path, "height_method", HEIGHT, {"same_height": "height_method:SameHeight"})
    return tmp_path


def test_a_method_of_another_package_runs_with_its_parameters_and_its_own_dimensions(brought):
    done = run(brought, "-c", USE)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    told = json.loads(done.stdout)
    assert told["specs"] == ["same_height.height_std"]
    assert told["events"] > 10
    assert told["detail"] == {"what": "height"}
    assert told["dimensions"] == 2
    assert told["mapping"] == 0.2


def test_the_command_line_knows_a_method_of_another_package(brought, tmp_path):
    bag = tmp_path / "walk"
    made = simulate(WalkConfig(route="L", standing=4.0, rate=60.0), seed=1)
    write_bag(bag, Recording(made.left, made.right))
    command = ["evaluate", str(bag), "--method", "same_height", "--json"]
    done = run(brought, "-m", "dualfoot_ros", *command)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["method"] == "same_height"
    refused = run(brought, "-m", "dualfoot_ros", "evaluate", str(bag), "--method", "sam_height")
    assert refused.returncode == 2
    assert "same_height" in refused.stderr


@pytest.mark.parametrize(
    ("text", "points", "why"),
    [
        ("raise RuntimeError('broken')", {"mine": "other:Mine"}, "broken"),
        ("Mine = 3", {"mine": "other:Mine"}, "not a class derived from Method"),
        (HEIGHT, {"mine": "other:SameHeight"}, "its name is 'same_height'"),
        (HEIGHT, {"idc": "other:SameHeight"}, "its name is 'same_height'"),
        (
            HEIGHT.replace('"same_height"', '"idc"'),
            {"idc": "other:SameHeight"},
            "a method of that name already",
        ),
    ],
)
def test_a_package_whose_method_cannot_be_used_is_named_and_harms_nothing(
    tmp_path, text, points, why
):
    package(tmp_path, "other", text, points)
    code = "from dualfoot_ros.core import METHODS; print(len(METHODS), METHODS['idc'].__module__)"
    done = run(tmp_path, "-c", code)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(len(METHODS.own)), "dualfoot_ros.core.constraints.idc"]
    assert why in done.stderr
    assert next(iter(points)) in done.stderr


def test_other_packages_are_not_looked_for_when_the_core_is_imported(brought):
    code = "import sys, dualfoot_ros.core; print('height_method' in sys.modules)"
    assert run(brought, "-c", code).stdout.strip() == "False"


def test_a_class_without_a_config_of_parameters_is_refused():
    broken = type("Broken", (Method,), {"name": "broken", "config_class": dict})
    with pytest.raises(ConfigError, match=r"config_class .* is not derived from Parameters"):
        checked(broken, "broken")


def test_every_method_tells_its_dimensions_and_only_the_rigid_pair_has_one_shoe():
    dimensions = {
        name: method(TrackerConfig.from_mapping({"method": name}).constraint).dimensions
        for name, method in METHODS.items()
    }
    assert {name for name, count in dimensions.items() if count == 3} == {
        "step_length",
        "rigid_pair",
        "spacing_vector",
    }
    assert [name for name, method in METHODS.items() if method.sensors_on_one_shoe] == [
        "rigid_pair"
    ]


class AsksAtStart(Method):
    """Asks for nothing at the start of a stance, but wants to know of it."""

    name = "asks_at_start"

    def on_stance_start(self, stance, gait):
        return ()


def test_only_those_who_answer_are_asked_at_the_start_of_a_stance():
    config = AsksAtStart.config_class()
    assert AsksAtStart(config).asks_at_start
    asking = {
        name for name in METHODS if METHODS[name](METHODS[name].config_class()).asks_at_start
    }
    assert asking == {"varying_distance"}


def test_other_packages_are_looked_for_only_for_names_that_are_not_ours():
    """To look through all that is installed is a tenth of what a short command takes."""
    program = (
        "import sys; sys.modules['importlib.metadata'] = None; "  # an import of it fails
        "from dualfoot_ros.core import METHODS, DualFootTracker, TrackerConfig; "
        "DualFootTracker(TrackerConfig(method='idc')); print(METHODS['idc'].name)"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout == "idc\n", done.stderr
