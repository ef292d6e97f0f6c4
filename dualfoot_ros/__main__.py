"""``python -m dualfoot_ros`` is the ``dualfoot`` command."""

import sys

from .cli.main import main

sys.exit(main())
