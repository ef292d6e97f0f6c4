"""What a verb loads: nothing that it does not need, which would be most of its time."""

import subprocess
import sys
from dataclasses import replace

import pytest
from processes import ROOT, environment

from dualfoot_ros.recording import read_bag, write_bag

SCRIPT = """
import sys
from dualfoot_ros.cli.main import main
try:
    main({arguments})
except SystemExit:
    pass
loaded = {{name for name in {names} if name in sys.modules}}
sys.exit(f"loaded: {{', '.join(sorted(loaded))}}" if loaded else 0)
"""
FIGURES = ("matplotlib", "PIL")
LATER = ("dask", "bleak", "serial", "asyncio", "rich", "rclpy", "multiprocessing.pool")
SCIENCE = ("scipy.optimize", "scipy.signal", "scipy.stats", "scipy.interpolate", "scipy.io")
COMPILER = ("numba", "llvmlite")
NEEDED_BY_BAGS = ("scipy", "rosbags", "yaml")


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        (["info", "--help"], (*FIGURES, *LATER, *COMPILER, *NEEDED_BY_BAGS)),
        (["--help"], (*FIGURES, *LATER, *COMPILER, *NEEDED_BY_BAGS)),
        (["info", "--no-stances", "bags/demo"], (*FIGURES, *LATER, *SCIENCE, *COMPILER)),
    ],
)
def test_a_verb_loads_nothing_that_it_does_not_need(arguments, names):
    assert_loads_nothing_of(names, arguments)


def test_evaluate_loads_no_science_for_a_walk_with_truth(tmp_path):
    whole = read_bag(ROOT / "bags" / "demo")
    some = replace(whole, left=whole.left[:2000], right=whole.right[:2000])
    bag = str(write_bag(tmp_path / "walk", some))
    names = (*FIGURES, *LATER, *COMPILER, "scipy")
    assert_loads_nothing_of(names, ["evaluate", bag, "--json"])


def test_consistency_loads_nothing_of_what_only_uses_parts_that_it_needs():
    arguments = ["consistency", "--walks", "1", "--rate", "60", "--jobs", "1", "--json"]
    assert_loads_nothing_of((*FIGURES, *COMPILER, "scipy.signal", "scipy.stats"), arguments)


def assert_loads_nothing_of(names, arguments):
    script = SCRIPT.format(arguments=arguments, names=names)
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env=environment(),
        check=False,
    )
    assert done.returncode == 0, done.stderr[-500:]
