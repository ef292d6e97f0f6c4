"""Faces whose modules are imported late show what they list, and only when it is asked for."""

import subprocess
import sys
from ast import literal_eval
from importlib import import_module
from pathlib import Path

import pytest
from processes import environment

import dualfoot_ros

PACKAGE = Path(dualfoot_ros.__file__).parent
LAZY = sorted(
    path.parent.name
    for path in PACKAGE.glob("*/__init__.py")
    if "lazy_face(__name__)" in path.read_text(encoding="utf-8")
)


def test_there_are_lazy_faces():
    assert LAZY == ["calibration", "drivers", "evaluation", "recording", "timing"]


@pytest.mark.parametrize("room", LAZY)
def test_a_lazy_face_shows_every_name_that_it_lists(room):
    face = import_module(f"dualfoot_ros.{room}")
    assert all(getattr(face, name) is not None for name in face.__all__)
    assert set(face.__all__) <= set(dir(face))


@pytest.mark.parametrize("room", LAZY)
def test_no_name_that_comes_late_is_that_of_a_module_of_its_room(room):
    face = import_module(f"dualfoot_ros.{room}")
    shown = "[name for name in face.__all__ if name in vars(face)]"
    early = literal_eval(printed(f"import dualfoot_ros.{room} as face; print({shown})"))
    modules = {path.stem for path in (PACKAGE / room).glob("*")}
    assert not (set(face.__all__) - set(early)) & modules


def printed(code):
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment()
    )
    return done.stdout


@pytest.mark.parametrize("room", LAZY)
def test_a_name_that_a_face_does_not_have_is_missed_as_of_any_module(room):
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        _ = import_module(f"dualfoot_ros.{room}").nothing


def test_a_node_that_applies_a_calibration_imports_nothing_that_makes_one():
    code = "import sys, dualfoot_ros.nodes.fusion; print(*sys.modules)"
    loaded = set(printed(code).split())
    assert "dualfoot_ros.calibration.file" in loaded
    idle = {"calibration.walk", "drivers.source", "recording.read", "evaluation"}
    assert not {f"dualfoot_ros.{name}" for name in idle} & loaded


def test_what_tracks_a_walk_imports_nothing_that_evaluates_one():
    code = "import sys; from dualfoot_ros.evaluation import track_walk; print(*sys.modules)"
    loaded = set(printed(code).split())
    assert "dualfoot_ros.evaluation.track" in loaded
    idle = {"whole_evaluation", "gait", "metrics", "pipeline"}
    assert not {f"dualfoot_ros.evaluation.{name}" for name in idle} & loaded


def test_masked_arrays_are_not_imported_to_describe_a_bag():
    bag = PACKAGE.parent / "bags" / "demo"
    code = f"import sys; from dualfoot_ros.cli.main import main; main(['info', {str(bag)!r}])"
    assert printed(f"{code}; print('numpy.ma' in sys.modules)").endswith("\nFalse\n")
