"""What a verb loads: nothing that it does not need, which would be most of its time."""

import subprocess
import sys

import pytest
from processes import ROOT, environment

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
