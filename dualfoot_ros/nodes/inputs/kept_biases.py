"""Gyro biases that earlier walks have told: read when a node starts, kept when it ends."""

from __future__ import annotations

from collections.abc import Iterable

from rclpy.impl.rcutils_logger import RcutilsLogger

from ...calibration import BiasMemory, RememberedStand, stands_in
from ...core import CalibrationError, DualFootTracker, Event


class KeptBiases:
    """Gives a tracker the priors of a file, and adds to it what the stands of the walk tell."""

    def __init__(self, path: str, tracker: DualFootTracker, logger: RcutilsLogger) -> None:
        """Read ``path``; when it is empty nothing is read and nothing kept.

        Raises
        ------
        CalibrationError
            When the file is no bias memory.
        """
        self._path, self._logger = path, logger
        self._stands: dict[str, RememberedStand] = {}
        self._memory = BiasMemory.load(path) if path else BiasMemory()
        for foot, prior in self._memory.priors().items():
            tracker.declare_bias(foot, prior)

    def note(self, events: Iterable[Event]) -> None:
        """Take what happened at a pair."""
        if self._path:
            stands_in(events, self._stands)

    def save(self) -> None:
        """Write the file, when anybody has stood; a file that cannot be written is logged."""
        if not self._path or not self._stands:
            return
        for foot, stand in self._stands.items():
            self._memory.remember(foot, stand)
        self._stands.clear()
        problem = self._write()
        if problem is not None:
            self._logger.error(f"bias_memory {self._path} cannot be written: {problem}")

    def _write(self) -> Exception | None:
        try:
            self._memory.save(self._path)
        except (OSError, CalibrationError) as error:
            return error
        return None
