"""Work without end, for workers that are to be interrupted."""

import os


def busy(number: int) -> int:
    """Say in one write, since two workers share a file, that the work has begun; go on for ever."""
    os.write(1, b"on\n")
    while True:
        number += 1
