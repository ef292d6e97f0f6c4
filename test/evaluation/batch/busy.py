"""Work without end, for workers that are to be interrupted."""


def busy(number: int) -> int:
    """Say that the work has begun, and go on for ever."""
    print("on", flush=True)
    while True:
        number += 1
