"""Fill the cache of the compiled kernel: ``python -m dualfoot_ros.core.compiler``."""

import os
import sys

from .cache import cache_directory
from .compiled import compiled


def main() -> int:
    """Compile the kernel at low priority and say where it is kept."""
    if hasattr(os, "nice"):
        os.nice(5)
    try:
        compiled()
    except ImportError:
        sys.stdout.write(
            "neither a C compiler (cc) nor numba is here: the kernel runs interpreted, some "
            "thirty times slower; install gcc\n"
        )
        return 0
    sys.stdout.write(f"kernel compiled, cached in {cache_directory()}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
