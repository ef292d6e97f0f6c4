"""Files: captured bytes of a device, or a csv export, also while it is still being written."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from ...core import Parameters, SourceError, parameter
from .transport import CHUNK, POLL_S, Transport


@dataclass(frozen=True)
class FileConfig(Parameters):
    """Options of a file."""

    speed: float = parameter(
        1.0,
        "times as fast as recorded, by the device's own clock; 0 as fast as possible",
        minimum=0.0,
        maximum=1000.0,
    )
    follow: bool = parameter(False, "wait at the end for what is still being written")


class FileTransport(Transport):
    """A file, read from its start."""

    reopens = False

    def __init__(self, path: str, config: FileConfig | None = None) -> None:
        """Name the file; nothing is opened yet.

        Raises
        ------
        SourceError
            When there is no such file.
        """
        self._path = Path(path).expanduser()
        if not self._path.exists() or self._path.is_dir():
            raise SourceError(f"the file '{path}' does not exist or is a folder")
        super().__init__(str(path))
        config = config or FileConfig()
        self.speed, self._follow = config.speed, config.follow
        self._file: BinaryIO | None = None

    def open(self) -> None:
        """Open the file; raise :class:`OSError` when it cannot be read."""
        self._file = self._path.open("rb")

    def read(self) -> bytes | None:
        """Return the next bytes, or None at the end."""
        assert self._file is not None
        data = self._file.read(CHUNK)
        if data:
            return data
        if not self._follow:
            return None
        time.sleep(POLL_S)
        return b""

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None
