"""Work without end, for workers that are to be interrupted."""

import os


def busy(number: int) -> int:
    """Say that the work has begun, in one write since two workers share a file; never end."""
    os.write(1, b"on\n")
    while True:
        number += 1
