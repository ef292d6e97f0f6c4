"""What tests of several parts need: the real walks, where they are."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def dual_feet() -> Path:
    """Folder of the dual-feet data set; the test is skipped where it is absent."""
    default = ROOT.parent / "shared" / "data" / "dual_feet"
    folder = Path(os.environ.get("DUALFOOT_DATA", default))
    if not (folder / "README.md").exists():
        pytest.skip(f"the dual-feet data set is not in {folder}; set DUALFOOT_DATA to where it is")
    return folder
