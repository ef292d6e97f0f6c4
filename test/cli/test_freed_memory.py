"""What is freed is kept: arrays after arrays take no new pages from the system."""

import ctypes
import subprocess
import sys

import pytest

PAGES = 1000
ROUNDS = 40
SCRIPT = f"""
import resource, sys
import numpy as np
from dualfoot_ros.cli.process.freed_memory import keep_freed_memory
if sys.argv[1] == "kept":
    keep_freed_memory()
np.ones({PAGES} * 512)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for k in range({ROUNDS}):
    one, other = np.ones({PAGES} * 512), np.ones(({PAGES} + k) * 512)
    del one, other
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def faults(how: str) -> int:
    """Return how many pages were given to a process that makes and frees arrays."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, how], capture_output=True, text=True, check=True
    )
    return int(done.stdout)


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "mallopt"), reason="needs glibc")
def test_freed_arrays_are_taken_again_without_new_pages():
    assert 5 * faults("kept") < faults("as usual")
