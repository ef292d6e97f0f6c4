"""A bag that may not be opened is said to be so, and not to be damaged."""

from pathlib import Path

import pytest
from processes import ROOT

from dualfoot_ros.core import os_error_text
from dualfoot_ros.recording import read_bag

DEMO = ROOT / "bags" / "demo"


@pytest.mark.parametrize("bag", [DEMO, DEMO / "demo.mcap"])
def test_a_bag_without_permission_is_no_damaged_one(bag, monkeypatch):
    def refuse(path, *_):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(PermissionError) as found:
        read_bag(bag)
    assert os_error_text(found.value) == f"'{DEMO / 'demo.mcap'}': Permission denied"


def test_what_the_system_says_is_given_without_its_number():
    assert os_error_text(OSError(28, "No space left on device")) == "No space left on device"
    assert os_error_text(OSError("odd")) == "odd"
