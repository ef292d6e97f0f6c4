"""A clock that the test owns, in place of the machine's."""

import sys
import time

import pytest


class OwnTime:
    """Stands in for the module ``time`` where the package reads the monotonic or the wall clock.

    It stands still unless the test moves it on, however long the machine takes meanwhile.
    """

    def __init__(self) -> None:
        self.now_s = 1000.0

    def __getattr__(self, name: str):
        return getattr(time, name)

    def monotonic(self) -> float:
        return self.now_s

    def time_ns(self) -> int:
        return 10**18 + round(1e9 * self.now_s)

    def move_on(self, seconds: float) -> None:
        """Let time pass."""
        self.now_s += seconds


def put_in_place(monkeypatch: pytest.MonkeyPatch) -> OwnTime:
    """Put a clock of the test's own into every module of the package that has been imported."""
    own = OwnTime()
    for name, module in list(sys.modules.items()):
        if name.startswith("dualfoot_ros.") and vars(module).get("time") is time:
            monkeypatch.setattr(module, "time", own)
    return own
